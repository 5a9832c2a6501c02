// Accesses a trace through HDF5 itself, to damage it or to see its content without the code under test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/trace/hdf5_handle.hpp"

namespace broadside::tests {

using core::Handle;

struct RawItem {
  std::string path;  // "/trace/step", "/scene@dt_s"
  std::vector<std::uint64_t> shape;
  std::string type;  // "f32", "u64", "str"; "?" for anything that the schema does not know
  std::string unit;  // of a dataset; "" when it has none
};

inline Handle raw_open(const std::filesystem::path& file) {
  Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
  EXPECT_TRUE(opened) << file;
  return opened;
}

inline std::string raw_type(hid_t type) {
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  if (H5Tget_class(type) == H5T_FLOAT) return "f" + bits;
  if (H5Tget_class(type) == H5T_INTEGER) return (H5Tget_sign(type) == H5T_SGN_NONE ? "u" : "i") + bits;
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 ? "str" : "?";
}

inline std::vector<std::uint64_t> raw_shape(hid_t space) {
  std::vector<hsize_t> dims(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

inline std::string raw_unit(hid_t set) {
  if (H5Aexists(set, "unit") <= 0) return "";
  const Handle attribute(H5Aopen(set, "unit", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  std::string unit(H5Tget_size(type.get()), '\0');
  H5Aread(attribute.get(), type.get(), unit.data());
  return unit.substr(0, unit.find('\0'));
}

inline herr_t add_raw_attribute(hid_t object, const char* name, const H5A_info_t* /*info*/, void* items) {
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  static_cast<std::vector<RawItem>*>(items)->push_back(
      {std::string("@") + name, raw_shape(space.get()), raw_type(type.get()), ""});
  return 0;
}

inline herr_t add_raw_object(hid_t root, const char* name, const H5O_info_t* info, void* data) {
  auto& items = *static_cast<std::vector<RawItem>*>(data);
  const std::string path = std::string(name) == "." ? "/" : "/" + std::string(name);
  const Handle object(H5Oopen(root, name, H5P_DEFAULT), H5Oclose);
  std::vector<RawItem> attributes;
  H5Aiterate2(object.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, add_raw_attribute, &attributes);
  const bool is_dataset = info->type == H5O_TYPE_DATASET;
  for (RawItem& a : attributes) {
    if (is_dataset && a.path == "@unit") continue;
    a.path.insert(0, path);
    items.push_back(a);
  }
  if (!is_dataset) return 0;
  const Handle type(H5Dget_type(object.get()), H5Tclose);
  const Handle space(H5Dget_space(object.get()), H5Sclose);
  items.push_back({path, raw_shape(space.get()), raw_type(type.get()), raw_unit(object.get())});
  return 0;
}

// Every dataset and every attribute but the datasets' units.
inline std::vector<RawItem> raw_items(const std::filesystem::path& file) {
  const Handle opened = raw_open(file);
  std::vector<RawItem> items;
  H5Ovisit(opened.get(), H5_INDEX_NAME, H5_ITER_INC, add_raw_object, &items);
  return items;
}

inline void raw_remove(const std::filesystem::path& file, const std::string& path) {
  const Handle opened = raw_open(file);
  EXPECT_GE(H5Ldelete(opened.get(), path.c_str(), H5P_DEFAULT), 0) << path;
}

inline void raw_remove_attribute(const std::filesystem::path& file, const std::string& path, const std::string& name) {
  const Handle opened = raw_open(file);
  EXPECT_GE(H5Adelete_by_name(opened.get(), path.c_str(), name.c_str(), H5P_DEFAULT), 0) << path;
}

inline void raw_set_attribute(const std::filesystem::path& file, const std::string& path, const std::string& name,
                              hid_t type, const void* value) {
  const Handle opened = raw_open(file);
  const Handle object(H5Oopen(opened.get(), path.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle a(H5Aopen(object.get(), name.c_str(), H5P_DEFAULT), H5Aclose);
  EXPECT_GE(H5Awrite(a.get(), type, value), 0) << path << "@" << name;
}

// Overwrites the first bytes of a dataset of at most 1 MiB.
inline void raw_overwrite(const std::filesystem::path& file, const std::string& path, const void* value,
                          std::size_t bytes) {
  const Handle opened = raw_open(file);
  const Handle set(H5Dopen2(opened.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  std::vector<char> all(1U << 20U);
  EXPECT_GE(H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0) << path;
  std::memcpy(all.data(), value, bytes);
  EXPECT_GE(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0) << path;
}

// Puts another dataset in its place: zeros of that type and shape, of which HDF5 stores nothing.
inline void raw_replace(const std::filesystem::path& file, const std::string& path, hid_t type,
                        const std::vector<std::uint64_t>& shape) {
  raw_remove(file, path);
  const Handle opened = raw_open(file);
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  const std::vector<hsize_t> chunk(shape.size(), 1);
  const Handle space(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  const Handle set(
      H5Dcreate2(opened.get(), path.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT), H5Dclose);
  EXPECT_TRUE(set) << path;
}

}  // namespace broadside::tests
