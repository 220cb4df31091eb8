#include "clients/recording/series.hpp"

#include <algorithm>

namespace sluice::clients::h5 {
namespace {

constexpr std::size_t kChunkBytes = 8 << 10;
constexpr std::size_t kCompressedChunkBytes = 256 << 10;
constexpr unsigned kDeflateLevel = 4;

// Bytes of equal weight side by side are what deflate can make something of.
void compress(const Properties& properties) {
  check(H5Pset_shuffle(properties), "ask for shuffling");
  check(H5Pset_deflate(properties, kDeflateLevel), "ask for compression");
}

Shape with_length(hsize_t length, const Shape& row) {
  Shape shape{length};
  shape.insert(shape.end(), row.begin(), row.end());
  return shape;
}

}  // namespace

// No checksum filter: a chunk of several rows is rewritten as rows are added, and a kill in the middle of
// that must not cost the rows that are there already. Their bytes are rewritten as they were.
Series Series::create(hid_t file, const std::string& path, hid_t type, const Shape& row, std::size_t element,
                      const std::string& unit, Storage storage) {
  Series series;
  series.path_ = path;
  series.row_ = row;
  series.row_elements_ = elements(row);
  if (series.row_elements_ == 0) return series;

  const bool compressed = storage == Storage::kCompressed;
  const std::size_t chunk_bytes = compressed ? kCompressedChunkBytes : kChunkBytes;
  const hsize_t rows = std::max<hsize_t>(chunk_bytes / (series.row_elements_ * element), 1);
  const Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make dataset properties");
  const Shape chunk = with_length(rows, row);
  check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "set a chunk");
  if (compressed) compress(properties);
  const Space space(H5Screate_simple(static_cast<int>(chunk.size()), with_length(0, row).data(),
                                     with_length(H5S_UNLIMITED, row).data()),
                    "make a data space");
  series.dataset_ =
      Dataset(H5Dcreate2(file, path.c_str(), type, space, intermediate_groups(), properties, H5P_DEFAULT),
              "create a dataset");
  if (!unit.empty()) set_attribute(file, path, "unit", unit);
  return series;
}

Series Series::open(hid_t file, const std::string& path, const Shape& row) {
  Series series;
  series.path_ = path;
  series.row_ = row;
  series.row_elements_ = elements(row);
  if (series.row_elements_ == 0) return series;
  series.dataset_ = Dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "open a dataset");
  const Shape shape = shape_of(series.dataset_);
  if (shape.empty() || shape != with_length(shape.front(), row))
    throw Error(path + " has an unexpected shape");
  series.length_ = shape.front();
  return series;
}

Space Series::rows(hsize_t first, hsize_t count) const {
  Space space(H5Dget_space(dataset_), "read a shape");
  const Shape start = with_length(first, Shape(row_.size(), 0));
  const Shape extent = with_length(count, row_);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr),
        "select rows");
  return space;
}

void Series::append_raw(hid_t memory, const void* data, std::size_t count) {
  if (absent() || count == 0) return;
  const hsize_t added = count / row_elements_;
  check(H5Dset_extent(dataset_, with_length(length_ + added, row_).data()), "extend a dataset");
  const Shape extent = with_length(added, row_);
  const Space memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                           "make a data space");
  check(H5Dwrite(dataset_, memory, memory_space, rows(length_, added), H5P_DEFAULT, data), "write rows");
  length_ += added;
}

void Series::read_raw(hid_t memory, void* data, hsize_t first, hsize_t count) const {
  if (absent() || count == 0) return;
  const Shape extent = with_length(count, row_);
  const Space memory_space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                           "make a data space");
  if (H5Dread(dataset_, memory, memory_space, rows(first, count), H5P_DEFAULT, data) < 0)
    fail("read rows of " + path_);
}

}  // namespace sluice::clients::h5
