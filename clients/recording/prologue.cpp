#include "clients/recording/prologue.hpp"

#include <fmt/format.h>
#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>

#include "clients/recording/layout.hpp"

namespace sluice::clients {
namespace {

using protocol::Message;
using protocol::ProtocolError;

void write_metadata(hid_t file) {
  h5::create_group(file, "/h5md/author");
  h5::set_integers(file, "/h5md", "version", {1, 1});
  h5::set_attribute(file, "/h5md/author", "name", "sluice");
  h5::create_group(file, "/h5md/creator");
  h5::set_attribute(file, "/h5md/creator", "name", layout::kCreator);
}

void write_status(hid_t file) {
  h5::create_group(file, "/status");
  h5::set_attribute(file, "/status", "reason", layout::kRunning, layout::kReasonLength);
  h5::set_attribute(file, "/status", "detail", "", layout::kDetailLength);
  h5::set_attribute(file, "/status", "wall_seconds", "0", layout::kReasonLength);
}

std::string scene_json(const Scene& scene) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string json;
  if (!google::protobuf::util::MessageToJsonString(scene, &json, options).ok())
    throw ProtocolError("the scene cannot be written as JSON");
  return json;
}

std::string scene_text(const Scene& scene) {
  std::string text;
  google::protobuf::TextFormat::PrintToString(scene, &text);
  return text;
}

void write_build(hid_t file, const Build& build) {
  h5::set_attribute(file, "/h5md/creator", "version", build.version());
  h5::write_text(file, "/parameters/build/version", build.version());
  h5::write_text(file, "/parameters/build/compiler", build.compiler());
  h5::write_text(file, "/parameters/build/processor", build.processor());
  h5::write<std::uint64_t>(file, "/parameters/build/threads", build.threads());
}

void write_parameters(hid_t file, const Message& message) {
  const Welcome& welcome = message.header.welcome();
  const std::string bytes = welcome.SerializeAsString();
  h5::write<std::uint8_t>(file, "/parameters/welcome",
                          {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                          {bytes.size()});
  h5::set_integers(file, "/parameters", "format", {layout::format_of(welcome.scene())});
  h5::write_text(file, "/parameters/scene", scene_text(welcome.scene()));
  h5::write_text(file, "/parameters/scene_json", scene_json(welcome.scene()));
  h5::write_text(file, "/parameters/run_id", message.header.run_id());
  h5::write<std::int64_t>(file, "/parameters/interval_ns", welcome.interval_ns(), "ns");
  h5::write<std::uint64_t>(file, "/parameters/steps_per_interval", welcome.steps_per_interval());
  h5::write<std::uint64_t>(file, "/parameters/steps", welcome.steps());
  h5::write<double>(file, "/parameters/sound_speed", welcome.sound_speed(), "m s-1");
  h5::write<double>(file, "/parameters/particle_mass", welcome.particle_mass(), "kg");
  write_build(file, welcome.build());
}

h5::Shape shape_of(const Message& message, const char* array) {
  const auto shape = message.shape(array);
  return {shape.begin(), shape.end()};
}

void write_boundaries(hid_t file, const Message& welcome) {
  const auto positions = [&](const char* array, const char* path) {
    const h5::Shape shape = shape_of(welcome, array);
    if (shape.size() != 2 || shape[1] != 3)
      throw ProtocolError(
          fmt::format("array {} must be of shape [n, 3], not [{}]", array, fmt::join(shape, ", ")));
    h5::write<double>(file, path, welcome.array<double>(array), shape, "m");
  };
  positions("wall/position", "/particles/wall/position");
  positions("boundary/position", "/particles/boundary/position");
  const auto body = welcome.array<std::int32_t>("boundary/body");
  if (body.size() != shape_of(welcome, "boundary/position")[0])
    throw ProtocolError(
        fmt::format("array boundary/body has {} entries, one is needed for each particle", body.size()));
  h5::write<std::int32_t>(file, "/particles/boundary/body", body, {body.size()});
}

// Space is not periodic anywhere; positions have three components in two dimensions, too.
void write_boxes(hid_t file) {
  for (const char* group : {"/particles/fluid/box", "/particles/wall/box", "/particles/boundary/box"}) {
    h5::create_group(file, group);
    h5::set_integers(file, group, "dimension", {3});
    const h5::Type text(H5Tcopy(H5T_C_S1), "make a text type");
    h5::check(H5Tset_size(text, 4), "set a text's length");
    const hsize_t three = 3;
    const h5::Space space(H5Screate_simple(1, &three, nullptr), "make a data space");
    const h5::Attribute boundary(
        H5Acreate_by_name(file, group, "boundary", text, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        "create an attribute");
    h5::check(H5Awrite(boundary, text, "nonenonenone"), "write an attribute");
  }
}

}  // namespace

void write_prologue(hid_t file, const Message& welcome) {
  write_metadata(file);
  write_status(file);
  write_parameters(file, welcome);
  write_boundaries(file, welcome);
  write_boxes(file);
}

}  // namespace sluice::clients
