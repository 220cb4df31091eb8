#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sluice::clients::h5 {

// What the HDF5 library could not do, with its own innermost reason.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(const std::string& what);

// Every result of the C interface goes through here.
template <typename Result>
Result check(Result result, const char* what) {
  if (result < 0) fail(what);
  return result;
}

// Keeps the library from printing its error stack from this thread, and from closing files when the process
// exits. Call before any other function.
void silence();

template <herr_t (*close)(hid_t)>
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, const char* what) : id_(check(id, what)) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT: a handle stands for its identifier
  [[nodiscard]] bool valid() const { return id_ >= 0; }
  // Closes now and reports a failure, which the destructor cannot.
  void reset(const char* what) { check(close(std::exchange(id_, H5I_INVALID_HID)), what); }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

using File = Handle<H5Fclose>;
using Group = Handle<H5Gclose>;
using Dataset = Handle<H5Dclose>;
using Space = Handle<H5Sclose>;
using Type = Handle<H5Tclose>;
using Attribute = Handle<H5Aclose>;
using Object = Handle<H5Oclose>;
using Properties = Handle<H5Pclose>;

using Shape = std::vector<hsize_t>;

template <typename T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

template <typename T>
hid_t file_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_IEEE_F32LE;
  if constexpr (std::is_same_v<T, double>) return H5T_IEEE_F64LE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_STD_I32LE;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_STD_I64LE;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_STD_U64LE;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_STD_U8LE;
}

hsize_t elements(const Shape& shape);
Properties intermediate_groups();
bool exists(hid_t file, const std::string& path);
Shape shape_of(hid_t dataset);
Shape shape_at(hid_t file, const std::string& path);

void create_group(hid_t file, const std::string& path);
void link(hid_t file, const std::string& target, const std::string& path);

// Attributes are text of a fixed length, so that they can be rewritten under SWMR. A longer text is cut.
void set_attribute(hid_t file, const std::string& object, const std::string& name, const std::string& text,
                   std::size_t length = 0);
void rewrite_attribute(hid_t file, const std::string& object, const std::string& name,
                       const std::string& text);
std::string attribute(hid_t file, const std::string& object, const std::string& name);
void set_integers(hid_t file, const std::string& object, const std::string& name,
                  const std::vector<int>& values);

int integer(hid_t file, const std::string& object, const std::string& name);

// A dataset that is written once, before SWMR, protected by a checksum. An empty shape is a scalar.
void write_raw(hid_t file, const std::string& path, hid_t type, hid_t memory, const void* data,
               const Shape& shape);
void read_raw(hid_t file, const std::string& path, hid_t memory, void* data, const Shape& shape);
void write_text(hid_t file, const std::string& path, const std::string& text);
std::string read_text(hid_t file, const std::string& path);

template <typename T>
void write(hid_t file, const std::string& path, std::span<const T> data, const Shape& shape,
           const std::string& unit = "") {
  write_raw(file, path, file_type<T>(), memory_type<T>(), data.data(), shape);
  if (!unit.empty()) set_attribute(file, path, "unit", unit);
}

template <typename T>
void write(hid_t file, const std::string& path, T value, const std::string& unit = "") {
  write<T>(file, path, std::span<const T>(&value, 1), {}, unit);
}

template <typename T>
std::vector<T> read(hid_t file, const std::string& path, const Shape& shape) {
  std::vector<T> data(elements(shape));
  read_raw(file, path, memory_type<T>(), data.data(), shape);
  return data;
}

template <typename T>
T read(hid_t file, const std::string& path) {
  return read<T>(file, path, {}).front();
}

}  // namespace sluice::clients::h5
