#include "clients/recording/xdmf.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>

#include "clients/recording/frame_views.hpp"
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

std::string data_item(const std::string& file, const FrameView& view) {
  const bool is_real = view.type == Array::FLOAT32 || view.type == Array::FLOAT64;
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
      fmt::join(view.shape, " "), is_real ? "Float" : "Int", protocol::element_size(view.type), escaped(file),
      view.dataset);
}

void write_frame(std::ostream& out, const std::string& file, std::uint64_t frame, double time,
                 const std::vector<FrameView>& views) {
  fmt::print(out, "<Grid Name=\"frame {}\" GridType=\"Uniform\">\n<Time Value=\"{:.9g}\"/>\n", frame, time);
  for (const FrameView& view : views) {
    const std::string data = data_item(file, view);
    if (view.name == "position")
      fmt::print(out, "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data);
    else if (&view == &views.back())  // the readers of version 3 draw no points without
      fmt::print(out,
                 "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
                 "NodesPerElement=\"1\">{}</Topology>\n",
                 view.shape.front(), data);
    else
      fmt::print(out, "<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                 view.name, view.shape.size() == 2 ? "Vector" : "Scalar", data);
  }
  fmt::print(out, "</Grid>\n");
}

}  // namespace

void write_xdmf(const std::filesystem::path& path) {
  const Reader recording(path);
  const FrameViews views(recording);
  std::filesystem::path companion = path;
  std::ofstream out(companion.replace_extension(".xdmf"));
  fmt::print(out,
             "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
             "<Grid Name=\"fluid\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  for (std::uint64_t frame = 0; frame < recording.frames(); ++frame) {
    const double time = 1e-9 * static_cast<double>(recording.frame_header(frame).time_ns());
    if (const std::vector<FrameView> some = views.of(frame); !some.empty())
      write_frame(out, views.path().filename().string(), frame, time, some);
  }
  fmt::print(out, "</Grid>\n</Domain>\n</Xdmf>\n");
  if (!out.flush()) throw std::runtime_error("cannot write " + companion.string());
}

}  // namespace sluice::clients
