#pragma once

#include <map>
#include <string>
#include <vector>

#include "protocol/scene_file.hpp"

namespace sluice::protocol {

using Positions = std::map<std::string, Location, std::less<>>;

// What came out of a file and its overrides. `complete` unless reading stopped midway; unknown fields are
// passed over.
struct ParsedScene {
  bool complete = false;
  Scene scene;
  Positions positions;
  std::vector<Problem> problems;
};

// `file` is named in locations only.
ParsedScene parse_text(const std::string& text, const std::string& file);
ParsedScene parse_json(const std::string& text, const std::string& file);

// Sets one field from "path=value"; the value is written as in a textproto scene. Quotes around strings may
// be left out, and an index may be one past the end of a list.
void apply_override(const std::string& assignment, ParsedScene& parsed);

// The candidate most like `name` for "did you mean", or nothing when none is.
std::string nearest(std::string_view name, const std::vector<std::string>& candidates);
std::vector<std::string> field_names(const google::protobuf::Descriptor& type);

}  // namespace sluice::protocol
