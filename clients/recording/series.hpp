#pragma once

#include <limits>

#include "clients/recording/hdf5.hpp"
#include "clients/recording/storage.hpp"

namespace sluice::clients::h5 {

// What stands where a row has fewer slots than the dataset.
template <typename T>
constexpr T empty_slot() {
  if constexpr (std::is_floating_point_v<T>)
    return std::numeric_limits<T>::quiet_NaN();
  else
    return static_cast<T>(-1);
}

// A dataset that grows row by row. One whose rows are empty (bodies in a scene without any) is not in the
// file. Rows are alike, or in slots: their first extent is the row's own, and the dataset's that of the
// longest.
class Series {
 public:
  Series() = default;
  template <typename T>
  static Series create(hid_t file, const std::string& path, const Shape& row, const std::string& unit,
                       Storage storage = Storage::kPlain) {
    return create(file, path, {file_type<T>(), sizeof(T), 0, nullptr}, row, unit, storage);
  }
  // The first extent of `row` is what rows are expected to have; any may have more or less.
  template <typename T>
  static Series create_slots(hid_t file, const std::string& path, const Shape& row, const std::string& unit,
                             Storage storage = Storage::kPlain) {
    const T fill = empty_slot<T>();
    return create(file, path, {file_type<T>(), sizeof(T), memory_type<T>(), &fill}, row, unit, storage);
  }
  // Throws Error when it is absent or its rows have another shape.
  static Series open(hid_t file, const std::string& path, const Shape& row);
  static Series open_slots(hid_t file, const std::string& path, const Shape& row);

  // Appends data.size() / row size rows.
  template <typename T>
  void append(std::span<const T> data) {
    append_raw(memory_type<T>(), data.data(), data.size());
  }
  template <typename T>
  [[nodiscard]] std::vector<T> read(hsize_t first, hsize_t count) const {
    std::vector<T> data(count * row_elements_);
    read_raw(memory_type<T>(), data.data(), first, with_length(count, row_));
    return data;
  }
  // One row; in slots it may have more or less than those before.
  template <typename T>
  void append_row(std::span<const T> data) {
    append_row_raw(memory_type<T>(), data.data(), data.size());
  }
  // The first `slots` of a row.
  template <typename T>
  [[nodiscard]] std::vector<T> read_row(hsize_t row, hsize_t slots) const {
    std::vector<T> data(slots * slot_elements());
    read_raw(memory_type<T>(), data.data(), row, with_slots(slots));
    return data;
  }
  template <typename T>
  void append_one(T value) {
    append(std::span<const T>(&value, 1));
  }
  template <typename T>
  [[nodiscard]] T read_one(hsize_t row) const {
    return read<T>(row, 1).front();
  }
  [[nodiscard]] std::uint64_t length() const { return length_; }
  // Of the longest row.
  [[nodiscard]] std::uint64_t slots() const { return row_.front(); }
  // Rows are empty; the length says nothing.
  [[nodiscard]] bool absent() const { return !dataset_.valid(); }

 private:
  struct Element {
    hid_t type;
    std::size_t size;
    hid_t memory;      // of the fill value
    const void* fill;  // of empty slots; null where rows are alike
  };
  static Series create(hid_t file, const std::string& path, const Element& element, const Shape& row,
                       const std::string& unit, Storage storage);
  static Series open(hid_t file, const std::string& path, const Shape& row, bool in_slots);
  static Shape with_length(hsize_t length, const Shape& row);
  [[nodiscard]] Shape with_slots(hsize_t slots) const;
  [[nodiscard]] hsize_t slot_elements() const;
  void append_raw(hid_t memory, const void* data, std::size_t count);
  void append_row_raw(hid_t memory, const void* data, std::size_t count);
  void write(hid_t memory, const void* data, hsize_t first, const Shape& extent);
  void read_raw(hid_t memory, void* data, hsize_t first, const Shape& extent) const;
  [[nodiscard]] Space rows(hsize_t first, const Shape& extent) const;

  Dataset dataset_;
  std::string path_;
  Shape row_;  // in slots, with those of the longest row so far
  bool in_slots_ = false;
  hsize_t row_elements_ = 0;
  hsize_t length_ = 0;
};

}  // namespace sluice::clients::h5
