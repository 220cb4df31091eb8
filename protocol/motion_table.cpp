#include "protocol/motion_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

namespace sluice::protocol {
namespace {

constexpr int kMostKeys = 20'000;

struct Cell {
  std::string_view text;
  int column;  // from 1
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The cells of a line without its comment; none when nothing is left.
std::vector<Cell> cells_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<Cell> cells;
  if (trimmed(line).empty()) return cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view text = trimmed(line.substr(begin, end - begin));
    const auto at = text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data());
    cells.push_back({text, static_cast<int>(at) + 1});
    begin = end + 1;
  }
  return cells;
}

class Table {
 public:
  Table(const std::filesystem::path& path, const std::string& field, int dimension,
        std::vector<Problem>& problems)
      : file_(path.string()), field_(field), dimension_(dimension), problems_(problems) {}

  void read(Keyframes& keyframes) {
    std::ifstream file(file_);
    if (std::error_code error; !file || std::filesystem::is_directory(file_, error))
      return report(0, 0, fmt::format("cannot be read: {}", file ? "is a directory" : std::strerror(errno)));
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      const std::vector<Cell> cells = cells_of(line);
      if (cells.empty()) continue;
      if (headings_.empty()) {
        if (!read_headings(cells, number)) return;
      } else if (keyframes.key_size() == kMostKeys) {
        return report(number, 1, fmt::format("more than {} keys; leave some out", kMostKeys));
      } else if (!read_key(cells, number, keyframes)) {
        return;
      }
    }
    if (keyframes.key().empty()) report(0, 0, "holds no keys; give a line of headings and one for each key");
  }

 private:
  bool read_headings(const std::vector<Cell>& cells, int line) {
    const std::string known = dimension_ == 2 ? "time, x, y, angle" : "time, x, y, z, angle";
    for (const Cell& cell : cells) {
      const std::string_view name = trimmed(cell.text.substr(0, cell.text.find('[')));
      const bool usable =
          name == "time" || name == "x" || name == "y" || name == "angle" || (name == "z" && dimension_ == 3);
      if (!usable)
        return refuse(line, cell.column,
                      fmt::format("\"{}\" is no column of a motion; headings are {}", cell.text, known));
      if (std::find(headings_.begin(), headings_.end(), name) != headings_.end())
        return refuse(line, cell.column, fmt::format("a second column \"{}\"; remove one", name));
      headings_.emplace_back(name);
    }
    if (std::find(headings_.begin(), headings_.end(), "time") == headings_.end())
      return refuse(line, cells.front().column, "there is no column \"time\"; add it");
    return true;
  }

  bool read_key(const std::vector<Cell>& cells, int line, Keyframes& keyframes) {
    if (cells.size() != headings_.size())
      return refuse(line, cells.back().column,
                    fmt::format("{} values for {} columns ({})", cells.size(), headings_.size(),
                                fmt::join(headings_, ", ")));
    Keyframe key;
    key.mutable_offset()->Resize(dimension_, 0.0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0;
      const std::string_view text = cells[c].text;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return refuse(line, cells[c].column, fmt::format("\"{}\" is not a number ({})", text, headings_[c]));
      if (headings_[c] == "time" && !follows(value, keyframes))
        return refuse(line, cells[c].column,
                      fmt::format("{} s {}; times must increase from 0 or later", value,
                                  value < 0 ? "is negative" : "is not after the key before"));
      set(key, headings_[c], value);
    }
    *keyframes.add_key() = std::move(key);
    return true;
  }

  static bool follows(double time, const Keyframes& keyframes) {
    return keyframes.key().empty() ? time >= 0 : time > keyframes.key().rbegin()->time();
  }

  static void set(Keyframe& key, const std::string& heading, double value) {
    if (heading == "time") return key.set_time(value);
    if (heading == "angle") return key.set_angle(value);
    key.set_offset(heading[0] - 'x', value);
  }

  void report(int line, int column, std::string text) {
    problems_.push_back({{file_, line, column}, field_, std::move(text)});
  }
  bool refuse(int line, int column, std::string text) {
    report(line, column, std::move(text));
    return false;
  }

  std::string file_, field_;
  int dimension_;
  std::vector<Problem>& problems_;
  std::vector<std::string> headings_;
};

}  // namespace

void read_motion_table(const std::filesystem::path& path, const std::string& field, int dimension,
                       Keyframes& keyframes, std::vector<Problem>& problems) {
  Table(path, field, dimension, problems).read(keyframes);
}

}  // namespace sluice::protocol
