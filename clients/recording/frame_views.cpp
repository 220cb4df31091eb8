#include "clients/recording/frame_views.hpp"

#include <fmt/format.h>

#include <numeric>

#include "clients/recording/element.hpp"
#include "clients/recording/hdf5.hpp"
#include "clients/recording/layout.hpp"

namespace sluice::clients {
namespace {

constexpr const char* kVertex = "vertex";

h5::Space space(const h5::Shape& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "make a data space"};
}

// A dataset of the first rows of another, or of one of its rows.
void view(hid_t file, const FrameView& view, const std::string& source, const std::string& dataset,
          const h5::Shape& extents, std::uint64_t row) {
  const h5::Shape shape(view.shape.begin(), view.shape.end());
  h5::Shape start(extents.size(), 0), count = shape;
  if (extents.size() > shape.size()) {
    count.insert(count.begin(), 1);
    start.front() = row;
  }
  const h5::Space whole = space(shape), from = space(extents);
  h5::check(H5Sselect_hyperslab(from, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
            "select a row");
  const h5::Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make dataset properties");
  h5::check(H5Pset_virtual(properties, whole, source.c_str(), dataset.c_str(), from), "make a view");
  const hid_t type =
      view.type == Array::INT32
          ? H5T_STD_I32LE
          : with_element(view.type, []<typename T>(T /*element*/) { return h5::file_type<T>(); });
  const h5::Dataset made(
      H5Dcreate2(file, view.dataset.c_str(), type, whole, h5::intermediate_groups(), properties, H5P_DEFAULT),
      "create a dataset");
}

h5::File create(const std::filesystem::path& path) {
  const h5::Properties access(H5Pcreate(H5P_FILE_ACCESS), "make file properties");
  h5::check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "choose a file version");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), "create the file of views"};
}

}  // namespace

FrameViews::FrameViews(const Reader& recording) : recording_(recording), path_(recording.path()) {
  path_.replace_extension(".xdmf" + recording.path().extension().string());
  const h5::File file = create(path_);
  std::vector<std::int32_t> numbers(recording.slots());
  std::iota(numbers.begin(), numbers.end(), 0);
  h5::write<std::int32_t>(file, std::string("/") + kVertex, numbers, {numbers.size()});

  const std::string source = recording.path().filename().string();
  const std::uint64_t every = protocol::particles_every(recording.scene());
  const std::uint64_t rows = (recording.frames() + every - 1) / every;
  const auto fields = layout::particle_fields(recording.scene(), recording.slots());
  for (std::uint64_t frame = 0; frame < recording.frames(); frame += every) {
    const std::vector<FrameView> views = of(frame);
    for (std::size_t i = 0; i + 1 < views.size(); ++i) {
      h5::Shape extents = fields[i].row;
      extents.insert(extents.begin(), rows);
      view(file, views[i], source, fields[i].dataset, extents, frame / every);
    }
    if (!views.empty()) view(file, views.back(), ".", std::string("/") + kVertex, {numbers.size()}, 0);
  }
}

std::vector<FrameView> FrameViews::of(std::uint64_t frame) const {
  const std::uint64_t n = recording_.particles(frame);
  std::vector<FrameView> views;
  if (n == 0) return views;
  for (const layout::Field& field : layout::particle_fields(recording_.scene(), n)) {
    const std::string name = field.array.substr(field.array.find('/') + 1);
    views.push_back(
        {name, fmt::format("/{}/{}", frame, name), {field.row.begin(), field.row.end()}, field.type});
  }
  views.push_back({kVertex, fmt::format("/{}/{}", frame, kVertex), {n}, Array::INT32});
  return views;
}

}  // namespace sluice::clients
