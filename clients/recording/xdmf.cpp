#include "clients/recording/xdmf.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "clients/recording/layout.hpp"
#include "clients/recording/reader.hpp"
#include "protocol/array_layout.hpp"

namespace sluice::clients {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

// What a frame has of a dataset over all frames.
std::string hyperslab(const Reader& recording, const layout::Field& field, std::uint64_t row,
                      std::uint64_t rows, std::uint64_t n) {
  const bool vector = field.row.size() == 2;
  const std::string tail = vector ? " 3" : "";
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}{1}\">"
      "<DataItem Dimensions=\"3 {2}\" Format=\"XML\">{3} 0{4} 1 1{5} 1 {0}{1}</DataItem>"
      "<DataItem Dimensions=\"{6} {7}{1}\" NumberType=\"{8}\" Precision=\"{9}\" "
      "Format=\"HDF\">{10}:{11}</DataItem>"
      "</DataItem>",
      n, tail, vector ? 3 : 2, row, vector ? " 0" : "", vector ? " 1" : "", rows, field.row[0],
      field.type == Array::INT64 ? "Int" : "Float", protocol::element_size(field.type),
      escaped(recording.path().filename().string()), field.dataset);
}

void write_frame(std::ostream& out, const Reader& recording, const std::vector<layout::Field>& fields,
                 std::uint64_t frame) {
  const std::uint64_t n = recording.particles(frame), every = protocol::particles_every(recording.scene());
  const std::uint64_t rows = (recording.frames() + every - 1) / every;
  fmt::print(out, "<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{:.9g}\"/>\n", frame,
             1e-9 * static_cast<double>(recording.frame_header(frame).time_ns()));
  fmt::print(out, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\"/>\n",
             n);
  for (const auto& field : fields) {
    const std::string name = field.array.substr(field.array.find('/') + 1);
    const std::string data = hyperslab(recording, field, frame / every, rows, n);
    if (name == "position") {
      fmt::print(out, "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data);
    } else {
      fmt::print(out, "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name,
                 field.row.size() == 2 ? "Vector" : "Scalar", data);
    }
  }
  fmt::print(out, "</Grid>\n");
}

}  // namespace

void write_xdmf(const std::filesystem::path& path) {
  const Reader recording(path);
  std::filesystem::path companion = path;
  std::ofstream out(companion.replace_extension(".xdmf"));
  fmt::print(out,
             "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
             "<Grid Name=\"fluid\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  const auto fields = layout::particle_fields(recording.scene(), recording.slots());
  for (std::uint64_t frame = 0; frame < recording.frames(); ++frame)
    if (recording.particles(frame) > 0) write_frame(out, recording, fields, frame);
  fmt::print(out, "</Grid>\n</Domain>\n</Xdmf>\n");
  if (!out.flush()) throw std::runtime_error("cannot write " + companion.string());
}

}  // namespace sluice::clients
