#include "clients/recording/hdf5.hpp"

#include <algorithm>

namespace sluice::clients::h5 {
namespace {

herr_t keep_innermost(unsigned /*depth*/, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 1;  // stop
}

Type text_type(std::size_t length) {
  Type type(H5Tcopy(H5T_C_S1), "make a text type");
  check(H5Tset_size(type, std::max<std::size_t>(length, 1)), "set a text's length");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "set a text's padding");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "set a text's encoding");
  return type;
}

std::string padded(std::string text, std::size_t length) {
  text.resize(std::max<std::size_t>(length, 1));
  return text;
}

std::string trimmed(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

Space space_of(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), "make a scalar"};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "make a data space"};
}

// Only fixed-length text is written; anything else is another program's.
std::size_t text_length(hid_t type) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw Error("not a fixed-length text");
  return H5Tget_size(type);
}

}  // namespace

void fail(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Error("cannot " + what + (reason.empty() ? "" : ": " + reason));
}

void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

hsize_t elements(const Shape& shape) {
  hsize_t count = 1;
  for (const hsize_t extent : shape) count *= extent;
  return count;
}

Properties intermediate_groups() {
  Properties properties(H5Pcreate(H5P_LINK_CREATE), "make link properties");
  check(H5Pset_create_intermediate_group(properties, 1), "ask for intermediate groups");
  return properties;
}

bool exists(hid_t file, const std::string& path) {
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1)) {
    if (H5Lexists(file, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0;
}

Shape shape_of(hid_t dataset) {
  const Space space(H5Dget_space(dataset), "read a shape");
  Shape shape(static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space), "read a rank")));
  if (!shape.empty()) check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "read extents");
  return shape;
}

Shape shape_at(hid_t file, const std::string& path) {
  return shape_of(Dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "open a dataset"));
}

void create_group(hid_t file, const std::string& path) {
  Group(H5Gcreate2(file, path.c_str(), intermediate_groups(), H5P_DEFAULT, H5P_DEFAULT), "create a group");
}

void link(hid_t file, const std::string& target, const std::string& path) {
  check(H5Lcreate_hard(file, target.c_str(), file, path.c_str(), intermediate_groups(), H5P_DEFAULT),
        "create a link");
}

void set_attribute(hid_t file, const std::string& object, const std::string& name, const std::string& text,
                   std::size_t length) {
  const Type type = text_type(length == 0 ? text.size() : length);
  const Attribute made(H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space_of({}), H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                       "create an attribute");
  check(H5Awrite(made, type, padded(text, H5Tget_size(type)).data()), "write an attribute");
}

// The object is opened first: an attribute opened by path cannot be written (HDF5 1.10.8, "can't locate open
// attribute").
void rewrite_attribute(hid_t file, const std::string& object, const std::string& name,
                       const std::string& text) {
  const Object owner(H5Oopen(file, object.c_str(), H5P_DEFAULT), "open an object");
  const Attribute found(H5Aopen(owner, name.c_str(), H5P_DEFAULT), "open an attribute");
  const Type type(H5Aget_type(found), "read an attribute's type");
  check(H5Awrite(found, type, padded(text, text_length(type)).data()), "write an attribute");
}

std::string attribute(hid_t file, const std::string& object, const std::string& name) {
  const Attribute found(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                        "open an attribute");
  const Type type(H5Aget_type(found), "read an attribute's type");
  const Space space(H5Aget_space(found), "read an attribute's shape");
  if (H5Sget_simple_extent_npoints(space) != 1) throw Error("not a single text");
  std::string text(text_length(type), '\0');
  check(H5Aread(found, type, text.data()), "read an attribute");
  return trimmed(std::move(text));
}

void set_integers(hid_t file, const std::string& object, const std::string& name,
                  const std::vector<int>& values) {
  const Attribute made(H5Acreate_by_name(file, object.c_str(), name.c_str(), H5T_STD_I32LE,
                                         space_of({values.size()}), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       "create an attribute");
  check(H5Awrite(made, H5T_NATIVE_INT, values.data()), "write an attribute");
}

int integer(hid_t file, const std::string& object, const std::string& name) {
  const Attribute found(H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                        "open an attribute");
  const Space space(H5Aget_space(found), "read an attribute's shape");
  if (H5Sget_simple_extent_npoints(space) != 1) throw Error("not a single number");
  int value = 0;
  check(H5Aread(found, H5T_NATIVE_INT, &value), "read an attribute");
  return value;
}

void write_raw(hid_t file, const std::string& path, hid_t type, hid_t memory, const void* data,
               const Shape& shape) {
  const Properties properties(H5Pcreate(H5P_DATASET_CREATE), "make dataset properties");
  if (!shape.empty() && elements(shape) > 0) {
    check(H5Pset_chunk(properties, static_cast<int>(shape.size()), shape.data()), "set a chunk");
    check(H5Pset_fletcher32(properties), "ask for a checksum");
  }
  const Dataset dataset(
      H5Dcreate2(file, path.c_str(), type, space_of(shape), intermediate_groups(), properties, H5P_DEFAULT),
      "create a dataset");
  if (elements(shape) > 0)
    check(H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write a dataset");
}

void read_raw(hid_t file, const std::string& path, hid_t memory, void* data, const Shape& shape) {
  const Dataset dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "open a dataset");
  if (shape_of(dataset) != shape) throw Error(path + " has an unexpected shape");
  if (elements(shape) > 0)
    check(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "read a dataset");
}

// A text's length is the type's, and a checksum needs a chunk: one element in one chunk.
void write_text(hid_t file, const std::string& path, const std::string& text) {
  const Type type = text_type(text.size());
  write_raw(file, path, type, type, padded(text, text.size()).data(), {1});
}

std::string read_text(hid_t file, const std::string& path) {
  const Dataset dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "open a dataset");
  if (shape_of(dataset) != Shape{1}) throw Error(path + " has an unexpected shape");
  const Type type(H5Dget_type(dataset), "read a text's type");
  std::string text(text_length(type), '\0');
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "read a text");
  return trimmed(std::move(text));
}

}  // namespace sluice::clients::h5
