#include "clients/recording/series.hpp"

#include <algorithm>

namespace sluice::clients::h5 {
namespace {

constexpr std::size_t kChunkBytes = 8 << 10;
constexpr std::size_t kCompressedChunkBytes = 256 << 10;
constexpr hsize_t kFewestSlots = 64, kMostSlots = 4096;  // in a chunk
constexpr unsigned kDeflateLevel = 4;

// Bytes of equal weight side by side are what deflate can make something of.
void compress(const Properties& properties) {
  check(H5Pset_shuffle(properties), "ask for shuffling");
  check(H5Pset_deflate(properties, kDeflateLevel), "ask for compression");
}

// The shape of chunks of whole rows, or where rows are in slots of parts of them.
Shape chunk_shape(Shape row, std::size_t element, bool in_slots, Storage storage) {
  if (in_slots) row[0] = std::clamp(row[0], kFewestSlots, kMostSlots);
  const std::size_t bytes = storage == Storage::kCompressed ? kCompressedChunkBytes : kChunkBytes;
  Shape chunk{std::max<hsize_t>(bytes / (elements(row) * element), 1)};
  chunk.insert(chunk.end(), row.begin(), row.end());
  return chunk;
}

}  // namespace

Shape Series::with_length(hsize_t length, const Shape& row) {
  Shape shape{length};
  shape.insert(shape.end(), row.begin(), row.end());
  return shape;
}

// The shape of one row.
Shape Series::with_slots(hsize_t slots) const {
  Shape row = row_;
  if (in_slots_) row[0] = slots;
  return with_length(1, row);
}

hsize_t Series::slot_elements() const {
  hsize_t count = 1;
  for (std::size_t i = 1; i < row_.size(); ++i) count *= row_[i];
  return count;
}

// No checksum filter: a chunk of several rows is rewritten as rows are added, and a kill in the middle of
// that must not cost the rows that are there already. Their bytes are rewritten as they were.
Series Series::create(hid_t file, const std::string& path, const Element& element, const Shape& row,
                      const std::string& unit, Storage storage) {
  Series series;
  series.path_ = path;
  series.row_ = row;
  series.in_slots_ = element.fill != nullptr;
  series.row_elements_ = elements(row);
  if (series.row_elements_ == 0 && !series.in_slots_) return series;

  const Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make dataset properties");
  const Shape chunk = chunk_shape(row, element.size, series.in_slots_, storage);
  check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "set a chunk");
  if (storage == Storage::kCompressed) compress(properties);
  Shape most = with_length(H5S_UNLIMITED, row);
  if (series.in_slots_) {
    check(H5Pset_fill_value(properties, element.memory, element.fill), "set a fill value");
    series.row_[0] = 0;
    most[1] = H5S_UNLIMITED;
  }
  const Space space(
      H5Screate_simple(static_cast<int>(chunk.size()), with_length(0, series.row_).data(), most.data()),
      "make a data space");
  series.dataset_ = Dataset(
      H5Dcreate2(file, path.c_str(), element.type, space, intermediate_groups(), properties, H5P_DEFAULT),
      "create a dataset");
  if (!unit.empty()) set_attribute(file, path, "unit", unit);
  return series;
}

Series Series::open(hid_t file, const std::string& path, const Shape& row) {
  return open(file, path, row, false);
}

Series Series::open_slots(hid_t file, const std::string& path, const Shape& row) {
  return open(file, path, row, true);
}

Series Series::open(hid_t file, const std::string& path, const Shape& row, bool in_slots) {
  Series series;
  series.path_ = path;
  series.row_ = row;
  series.in_slots_ = in_slots;
  series.row_elements_ = elements(row);
  if (series.row_elements_ == 0 && !in_slots) return series;
  series.dataset_ = Dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "open a dataset");
  const Shape shape = shape_of(series.dataset_);
  if (in_slots && shape.size() > 1) series.row_[0] = shape[1];
  if (shape.empty() || shape != with_length(shape.front(), series.row_))
    throw Error(path + " has an unexpected shape");
  series.length_ = shape.front();
  return series;
}

Space Series::rows(hsize_t first, const Shape& extent) const {
  Space space(H5Dget_space(dataset_), "read a shape");
  Shape start(extent.size(), 0);
  start.front() = first;
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
        "select rows");
  return space;
}

void Series::append_raw(hid_t memory, const void* data, std::size_t count) {
  if (absent() || count == 0) return;
  const hsize_t added = count / row_elements_;
  check(H5Dset_extent(dataset_, with_length(length_ + added, row_).data()), "extend a dataset");
  write(memory, data, length_, with_length(added, row_));
  length_ += added;
}

void Series::append_row_raw(hid_t memory, const void* data, std::size_t count) {
  if (absent()) return;
  const hsize_t slots = in_slots_ ? count / slot_elements() : 0;
  if (in_slots_) row_[0] = std::max(row_[0], slots);
  check(H5Dset_extent(dataset_, with_length(length_ + 1, row_).data()), "extend a dataset");
  if (count > 0) write(memory, data, length_, with_slots(slots));
  ++length_;
}

void Series::write(hid_t memory, const void* data, hsize_t first, const Shape& extent) {
  const Space memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                           "make a data space");
  check(H5Dwrite(dataset_, memory, memory_space, rows(first, extent), H5P_DEFAULT, data), "write rows");
}

void Series::read_raw(hid_t memory, void* data, hsize_t first, const Shape& extent) const {
  if (absent() || elements(extent) == 0) return;
  const Space memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                           "make a data space");
  if (H5Dread(dataset_, memory, memory_space, rows(first, extent), H5P_DEFAULT, data) < 0)
    fail("read rows of " + path_);
}

}  // namespace sluice::clients::h5
