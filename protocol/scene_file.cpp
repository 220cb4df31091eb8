#include "protocol/scene_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "protocol/scene_check.hpp"
#include "protocol/scene_files.hpp"
#include "protocol/scene_parse.hpp"

namespace sluice::protocol {
namespace {

constexpr std::uintmax_t kLargestFile = 16 << 20;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string reason) {
  throw SceneError({{{path.string(), 0, 0}, "", std::move(reason)}});
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse(path, "is a directory; give a scene file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  std::string text;
  std::array<char, 1 << 16> chunk{};
  while (text.size() <= kLargestFile && (file.read(chunk.data(), chunk.size()), file.gcount() > 0))
    text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestFile)
    refuse(path, fmt::format("is larger than {} MiB, which no scene needs", kLargestFile >> 20));
  return text;
}

// Those without a position first: they concern the whole scene or the command line.
std::vector<Problem> in_reading_order(std::vector<Problem> problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  });
  return problems;
}

std::string join_lines(const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

// The path of the enclosing message or list, empty at the top.
std::string_view parent(std::string_view field) {
  const std::size_t end = field.find_last_of(".[");
  return end == std::string_view::npos ? std::string_view{} : field.substr(0, end);
}

}  // namespace

std::string to_string(const Problem& problem) {
  std::string text = problem.where.file;
  if (problem.where.line > 0) text += fmt::format(":{}:{}", problem.where.line, problem.where.column);
  if (!text.empty()) text += ": ";
  if (!problem.field.empty()) text += problem.field + ": ";
  return text + problem.text;
}

SceneError::SceneError(std::vector<Problem> problems)
    : InputError(join_lines(problems)), problems_(std::move(problems)) {}

SceneError::SceneError(std::string field, std::string text)
    : SceneError(std::vector<Problem>{{{}, std::move(field), std::move(text)}}) {}

SceneFile SceneFile::load(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  const std::string text = read_text(path);
  const bool json = path.extension() == ".json";
  ParsedScene parsed = json ? parse_json(text, path.string()) : parse_text(text, path.string());
  for (const auto& assignment : overrides) apply_override(assignment, parsed);
  if (parsed.complete) read_named_files(path, parsed);

  SceneFile result;
  result.file_ = path.string();
  result.scene_ = std::move(parsed.scene);
  result.positions_ = std::move(parsed.positions);
  // What a half-read scene lacks is not the user's omission.
  if (parsed.complete) {
    for (auto& problem : check_fields(result.scene_)) {
      problem.where = result.locate(problem.field);
      parsed.problems.push_back(std::move(problem));
    }
  }
  if (!parsed.problems.empty()) throw SceneError(in_reading_order(std::move(parsed.problems)));
  return result;
}

Location SceneFile::locate(std::string_view field) const {
  for (; !field.empty(); field = parent(field)) {
    if (const auto found = positions_.find(field); found != positions_.end()) return found->second;
  }
  return {file_, 0, 0};
}

}  // namespace sluice::protocol
