#include "protocol/scene_parse.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace sluice::protocol {
namespace {

namespace pb = google::protobuf;

constexpr int kDeepestNesting = 16;

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n')
      lines.emplace_back();
    else
      lines.back().push_back(c);
  }
  return lines;
}

// The word between the n-th pair of quotes of a Protobuf message.
std::string quoted(const std::string& text, int n) {
  std::size_t begin = 0;
  for (int i = 0; i < 2 * n + 1 && begin != std::string::npos; ++i) begin = text.find('"', begin + (i > 0));
  if (begin == std::string::npos) return {};
  return text.substr(begin + 1, text.find('"', begin + 1) - begin - 1);
}

// Turns what the parser says into problems.
class Collector : public pb::io::ErrorCollector {
 public:
  Collector(const std::string& text, std::string file, std::vector<Problem>& problems)
      : lines_(split_lines(text)), file_(std::move(file)), problems_(problems) {}

  void AddError(int line, pb::io::ColumnNumber column, const std::string& message) override {
    report(line, column, message);
  }
  void AddWarning(int line, pb::io::ColumnNumber column, const std::string& message) override {
    report(line, column, message);
  }

 private:
  void report(int line, int column, const std::string& message) {
    if (message.find("has no field named") != std::string::npos) return report_unknown(line, column, message);
    // These come when the parser has passed the word they are about.
    const bool passed = message.starts_with("Unknown enumeration") ||
                        message.starts_with("Non-repeated field") || message.starts_with("Field \"");
    const Location here{file_, line + 1, column + 1};
    problems_.push_back({passed ? start_of(quoted(message, 0), line, column) : here, "", message});
  }

  void report_unknown(int line, int column, const std::string& message) {
    const std::string type = quoted(message, 0);
    const std::string name = quoted(message, 1);
    const pb::Descriptor* descriptor = Scene::descriptor()->file()->pool()->FindMessageTypeByName(type);
    const auto names = descriptor != nullptr ? field_names(*descriptor) : std::vector<std::string>{};
    const std::string likely = nearest(name, names);
    problems_.push_back({start_of(name, line, column), name,
                         fmt::format("{} has no such field; {}", type.substr(type.rfind('.') + 1),
                                     likely.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                                                    : fmt::format("did you mean {}?", likely))});
  }

  // Where the word stands, going back from where its value begins.
  [[nodiscard]] Location start_of(const std::string& name, int line, int column) const {
    std::size_t from = static_cast<std::size_t>(column);
    for (int l = line; l >= 0 && static_cast<std::size_t>(l) < lines_.size(); --l) {
      const std::size_t found = lines_[static_cast<std::size_t>(l)].rfind(name, from);
      if (found != std::string::npos) return {file_, l + 1, static_cast<int>(found) + 1};
      from = std::string::npos;
    }
    return {file_, line + 1, column + 1};
  }

  std::vector<std::string> lines_;
  std::string file_;
  std::vector<Problem>& problems_;
};

// Fills the positions of all fields of a message. The tree knows only the first entry of a list in brackets;
// the others share its position.
void collect_positions(const pb::Message& message, const pb::TextFormat::ParseInfoTree& tree,
                       const std::string& prefix, const std::string& file, Positions& positions) {
  const auto* reflection = message.GetReflection();
  for (int f = 0; f < message.GetDescriptor()->field_count(); ++f) {
    const auto* field = message.GetDescriptor()->field(f);
    const std::string path = prefix + field->name();
    const bool repeated = field->is_repeated();
    const int count = repeated ? reflection->FieldSize(message, field) : 1;
    pb::TextFormat::ParseLocation last;
    for (int i = 0; i < count; ++i) {
      const auto here = tree.GetLocation(field, repeated ? i : -1);
      if (here.line >= 0) last = here;
      if (last.line < 0) continue;
      const Location location{file, last.line + 1, last.column + 1};
      const std::string entry = repeated ? fmt::format("{}[{}]", path, i) : path;
      positions.try_emplace(path, location);
      positions.try_emplace(entry, location);
      if (field->cpp_type() != pb::FieldDescriptor::CPPTYPE_MESSAGE) continue;
      const auto* nested = tree.GetTreeForNested(field, repeated ? i : -1);
      const auto& child = repeated ? reflection->GetRepeatedMessage(message, field, i)
                                   : reflection->GetMessage(message, field);
      if (nested != nullptr) collect_positions(child, *nested, entry + ".", file, positions);
    }
  }
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substitution, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> field_names(const pb::Descriptor& type) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

std::string nearest(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(name.size() / 2, 1) + 1;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(name.substr(0, 64), candidate);
    if (distance >= least) continue;
    least = distance;
    best = candidate;
  }
  return best;
}

ParsedScene parse_text(const std::string& text, const std::string& file) {
  ParsedScene parsed;
  Collector collector(text, file, parsed.problems);
  pb::TextFormat::ParseInfoTree tree;
  pb::TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(&tree);
  parser.SetRecursionLimit(kDeepestNesting);
  parser.AllowUnknownField(true);  // reported as a warning, so that the rest is checked too
  parsed.complete = parser.ParseFromString(text, &parsed.scene);
  if (!parsed.complete && parsed.problems.empty())
    parsed.problems.push_back({{file, 0, 0}, "", "is not a scene in textproto form"});
  collect_positions(parsed.scene, tree, "", file, parsed.positions);
  return parsed;
}

ParsedScene parse_json(const std::string& text, const std::string& file) {
  ParsedScene parsed;
  const auto status = pb::util::JsonStringToMessage(text, &parsed.scene);
  parsed.complete = status.ok();
  if (!parsed.complete) parsed.problems.push_back({{file, 0, 0}, "", std::string(status.message())});
  return parsed;
}

}  // namespace sluice::protocol
