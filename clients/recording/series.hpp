#pragma once

#include "clients/recording/hdf5.hpp"
#include "clients/recording/storage.hpp"

namespace sluice::clients::h5 {

// A dataset that grows row by row. One whose rows are empty (bodies in a scene without any) is not in the
// file.
class Series {
 public:
  Series() = default;
  template <typename T>
  static Series create(hid_t file, const std::string& path, const Shape& row, const std::string& unit,
                       Storage storage = Storage::kPlain) {
    return create(file, path, file_type<T>(), row, sizeof(T), unit, storage);
  }
  // Throws Error when it is absent or its rows have another shape.
  static Series open(hid_t file, const std::string& path, const Shape& row);

  // Appends data.size() / row size rows.
  template <typename T>
  void append(std::span<const T> data) {
    append_raw(memory_type<T>(), data.data(), data.size());
  }
  template <typename T>
  [[nodiscard]] std::vector<T> read(hsize_t first, hsize_t count) const {
    std::vector<T> data(count * row_elements_);
    read_raw(memory_type<T>(), data.data(), first, count);
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
  // Rows are empty; the length says nothing.
  [[nodiscard]] bool absent() const { return !dataset_.valid(); }

 private:
  static Series create(hid_t file, const std::string& path, hid_t type, const Shape& row, std::size_t element,
                       const std::string& unit, Storage storage);
  void append_raw(hid_t memory, const void* data, std::size_t count);
  void read_raw(hid_t memory, void* data, hsize_t first, hsize_t count) const;
  [[nodiscard]] Space rows(hsize_t first, hsize_t count) const;

  Dataset dataset_;
  std::string path_;
  Shape row_;
  hsize_t row_elements_ = 0;
  hsize_t length_ = 0;
};

}  // namespace sluice::clients::h5
