#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "protocol/scene_parse.hpp"

namespace sluice::protocol {
namespace {

namespace pb = google::protobuf;
using pb::FieldDescriptor;

// One step of a path: a field's name, and an index when it is followed by [i].
struct Step {
  std::string name;
  std::optional<int> index;
};

class BadOverride : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Step parse_step(const std::string& text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string::npos) return {text, std::nullopt};
  int index = -1;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + bracket + 1, end, index);
  if (error != std::errc{} || stop + 1 != end || *stop != ']' || index < 0)
    throw BadOverride(fmt::format("{}: an index is written [0], [1] ...", text));
  return {text.substr(0, bracket), index};
}

std::vector<Step> parse_path(const std::string& path) {
  std::vector<Step> steps;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    steps.push_back(parse_step(path.substr(begin, end - begin)));
    begin = end + 1;
  }
  return steps;
}

const FieldDescriptor& find_field(const pb::Message& message, const std::string& name,
                                  const std::string& where) {
  const auto& type = *message.GetDescriptor();
  if (const auto* field = type.FindFieldByName(name)) return *field;
  const auto names = field_names(type);
  const std::string likely = nearest(name, names);
  throw BadOverride(fmt::format("{} has no field \"{}\"; {}", where.empty() ? "the scene" : where, name,
                                likely.empty() ? fmt::format("it has {}", fmt::join(names, ", "))
                                               : fmt::format("did you mean {}?", likely)));
}

// Setting a part of one choice must not silently discard another, e.g. the ball's radius of a box.
void check_choice(const pb::Message& message, const FieldDescriptor& field) {
  const auto* choice = field.real_containing_oneof();
  if (choice == nullptr) return;
  const auto* current = message.GetReflection()->GetOneofFieldDescriptor(message, choice);
  if (current != nullptr && current != &field)
    throw BadOverride(fmt::format("{} is given, not {}; an override can change its fields but not the {}",
                                  current->name(), field.name(), choice->name()));
}

void check_index(int index, int size, const std::string& where) {
  if (index <= size) return;
  throw BadOverride(fmt::format("{}[{}] does not exist; the scene has {}", where, index,
                                size == 0 ? "none" : fmt::format("indices 0 to {}", size - 1)));
}

pb::Message& descend(pb::Message& message, const Step& step, const std::string& where) {
  const FieldDescriptor& field = find_field(message, step.name, where);
  const std::string path = (where.empty() ? "" : where + ".") + step.name;
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE)
    throw BadOverride(fmt::format("{} is a value and has no fields", path));
  if (field.is_repeated() != step.index.has_value())
    throw BadOverride(field.is_repeated()
                          ? fmt::format("{} is a list; write {}[0] for its first entry", path, path)
                          : fmt::format("{} is not a list; leave out [{}]", path, *step.index));
  check_choice(message, field);
  const auto* reflection = message.GetReflection();
  if (!step.index) return *reflection->MutableMessage(&message, &field);
  const int size = reflection->FieldSize(message, &field);
  check_index(*step.index, size, path);
  return *step.index == size ? *reflection->AddMessage(&message, &field)
                             : *reflection->MutableRepeatedMessage(&message, &field, *step.index);
}

std::string expected(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_ENUM: {
      std::vector<std::string> names(static_cast<std::size_t>(field.enum_type()->value_count()));
      for (int n = 0; auto& name : names) name = field.enum_type()->value(n++)->name();
      return fmt::format("one of {}", fmt::join(names, ", "));
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return fmt::format("{{ ... }} with {}", fmt::join(field_names(*field.message_type()), ", "));
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_STRING:
      return "a text";
    default:
      return "a number";
  }
}

std::string quote_if_needed(const FieldDescriptor& field, const std::string& value) {
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_STRING || value.starts_with('"') ||
      value.starts_with('\''))
    return value;
  std::string escaped = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped + '"';
}

class Silent : public pb::io::ErrorCollector {
 public:
  void AddError(int, pb::io::ColumnNumber, const std::string&) override {}
};

// A message of the same type with this field alone set; the parser gets no chance to touch another.
std::unique_ptr<pb::Message> parse_value(const pb::Message& like, const FieldDescriptor& field, bool entry,
                                         const std::string& value) {
  std::unique_ptr<pb::Message> parsed(like.New());
  Silent silent;
  pb::TextFormat::Parser parser;
  parser.RecordErrorsTo(&silent);
  parser.SetRecursionLimit(16);
  const std::string text = quote_if_needed(field, value);
  const bool list = field.is_repeated() && !entry;
  bool valid = list ? parser.ParseFromString(field.name() + ": " + text, parsed.get())
                    : parser.ParseFieldValueFromString(text, &field, parsed.get());
  std::vector<const FieldDescriptor*> set;
  parsed->GetReflection()->ListFields(*parsed, &set);
  for (const auto* other : set) valid = valid && other == &field;
  if (!valid)
    throw BadOverride(fmt::format("\"{}\" is not {}{}", value,
                                  list ? "a list [a, b ...] whose entries are " : "", expected(field)));
  return parsed;
}

void assign(pb::Message& message, const Step& step, const std::string& where, const std::string& value) {
  const FieldDescriptor& field = find_field(message, step.name, where);
  const std::string path = (where.empty() ? "" : where + ".") + step.name;
  if (step.index && !field.is_repeated())
    throw BadOverride(fmt::format("{} is not a list; leave out [{}]", path, *step.index));
  check_choice(message, field);
  const auto* reflection = message.GetReflection();
  const auto parsed = parse_value(message, field, step.index.has_value(), value);
  if (!step.index) {
    reflection->ClearField(&message, &field);
    message.MergeFrom(*parsed);
    return;
  }
  const int size = reflection->FieldSize(message, &field);
  check_index(*step.index, size, path);
  message.MergeFrom(*parsed);
  if (*step.index == size) return;
  reflection->SwapElements(&message, &field, *step.index, size);
  reflection->RemoveLast(&message, &field);
}

// Positions of what was replaced, and of what is below it, no longer hold.
void move_positions(const std::string& path, const Location& location, Positions& positions) {
  std::erase_if(positions, [&](const auto& entry) {
    return entry.first.starts_with(path + ".") || entry.first.starts_with(path + "[");
  });
  positions.insert_or_assign(path, location);
}

}  // namespace

void apply_override(const std::string& assignment, ParsedScene& parsed) {
  const Location location{"--set " + assignment, 0, 0};
  const std::size_t equals = assignment.find('=');
  const std::string path = assignment.substr(0, equals);
  try {
    if (equals == std::string::npos || path.empty())
      throw BadOverride("an override is written PATH=VALUE, e.g. spacing=0.002 or body[0].density=500");
    const auto steps = parse_path(path);
    pb::Message* message = &parsed.scene;
    std::string where;
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      message = &descend(*message, steps[i], where);
      where += (where.empty() ? "" : ".") + steps[i].name;
      if (steps[i].index) where += fmt::format("[{}]", *steps[i].index);
    }
    assign(*message, steps.back(), where, assignment.substr(equals + 1));
    move_positions(path, location, parsed.positions);
  } catch (const BadOverride& error) {
    parsed.problems.push_back({location, path, error.what()});
  }
}

}  // namespace sluice::protocol
