#include "core/trace/hdf5_sink.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace broadside::core {
namespace {

// Fixed length, UTF-8, padded with zeros. HDF5 has no string of length 0.
Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(length, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

bool write_attribute(hid_t object, const std::string& name, hid_t type, const Handle& space, const void* data) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute.get(), type, data) >= 0;
}

// Shuffle + gzip 1, no times of day in object headers, so that equal traces are equal files as far as HDF5 allows.
Handle creation_properties(std::span<const hsize_t> chunk) {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  if (!chunk.empty()) {
    H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 1);
  }
  return properties;
}

}  // namespace

hid_t hdf5_type(Element element) {
  switch (element) {
    case Element::kU8:
      return H5T_STD_U8LE;
    case Element::kU32:
      return H5T_STD_U32LE;
    case Element::kU64:
      return H5T_STD_U64LE;
    case Element::kF32:
      return H5T_IEEE_F32LE;
    case Element::kF64:
      return H5T_IEEE_F64LE;
  }
  return H5I_INVALID_HID;
}

bool Hdf5Sink::note(bool good, const std::string& path) {
  if (!good && failed_at_.empty()) failed_at_ = path;
  return good;
}

void Hdf5Sink::group(const std::string& path) {
  if (!ok()) return;
  const Handle group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  note(static_cast<bool>(group), path);
}

void Hdf5Sink::number(const std::string& path, const std::string& name, Element element, const void* values,
                      std::size_t count) {
  if (!ok()) return;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  const hsize_t dims = count;
  const Handle space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &dims, nullptr), H5Sclose);
  note(object && write_attribute(object.get(), name, hdf5_type(element), space, values), path + "@" + name);
}

void Hdf5Sink::text(const std::string& path, const std::string& name, const std::string& value) {
  if (!ok()) return;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type = text_type(value.size());
  note(object && write_attribute(object.get(), name, type.get(), space, value.c_str()), path + "@" + name);
}

void Hdf5Sink::array(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows,
                     const void* data, const std::string& unit) {
  if (!ok()) return;
  const hsize_t dims[2] = {rows, width};
  const std::size_t rank = width == 1 ? 1 : 2;
  const std::uint64_t bytes_per_row = width * size_of(element);
  const hsize_t chunk[2] = {std::max<hsize_t>(1, kChunkBytes / bytes_per_row), width};
  const bool compress = rows > chunk[0];
  const Handle properties = creation_properties(std::span(chunk, compress ? rank : 0));
  const Handle space(H5Screate_simple(static_cast<int>(rank), dims, nullptr), H5Sclose);
  const Handle set(
      H5Dcreate2(file_, path.c_str(), hdf5_type(element), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose);
  const bool good =
      set && (rows == 0 || H5Dwrite(set.get(), hdf5_type(element), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
  if (note(good, path)) text(path, "unit", unit);
}

void Hdf5Sink::texts(const std::string& path, const std::vector<std::string>& values, const std::string& unit) {
  if (!ok()) return;
  std::size_t longest = 1;
  for (const std::string& v : values) longest = std::max(longest, v.size());
  std::vector<char> padded(longest * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i) std::memcpy(&padded[i * longest], values[i].data(), values[i].size());
  const hsize_t dims = values.size();
  const Handle type = text_type(longest);
  const Handle properties = creation_properties({});
  const Handle space(H5Screate_simple(1, &dims, nullptr), H5Sclose);
  const Handle set(H5Dcreate2(file_, path.c_str(), type.get(), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
                   H5Dclose);
  const bool good =
      set && (values.empty() || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) >= 0);
  if (note(good, path)) text(path, "unit", unit);
}

Handle Hdf5Sink::growing(const Column& column, std::uint64_t bodies) {
  if (!ok()) return {};
  const bool per_body = column.layout == Layout::kFrameBodies;
  // [F, n, width], or [F] / [F, width]. A fixed dimension of 0 cannot be chunked, so no bodies get room for one.
  hsize_t dims[3] = {0, per_body ? bodies : column.width, column.width};
  hsize_t most[3] = {H5S_UNLIMITED, std::max<hsize_t>(1, dims[1]), column.width};
  const int rank = per_body ? 3 : (column.width == 1 ? 1 : 2);
  hsize_t chunk[3] = {1, most[1], column.width};
  if (per_body) chunk[1] = std::min<hsize_t>(chunk[1], std::max<hsize_t>(1, 8 * kChunkBytes / row_bytes(column)));
  const std::uint64_t slice_bytes = per_body ? chunk[1] * row_bytes(column) : row_bytes(column);
  chunk[0] = std::max<hsize_t>(1, kChunkBytes / slice_bytes);

  const std::string path(column.path);
  const Handle properties = creation_properties(std::span(chunk, static_cast<std::size_t>(rank)));
  if (column.records == Records::kStep) {
    const std::uint64_t missing = std::numeric_limits<std::uint64_t>::max();
    H5Pset_fill_value(properties.get(), H5T_NATIVE_UINT64, &missing);
  }
  const Handle space(H5Screate_simple(rank, dims, most), H5Sclose);
  Handle set(H5Dcreate2(file_, path.c_str(), hdf5_type(column.element), space.get(), H5P_DEFAULT, properties.get(),
                        H5P_DEFAULT),
             H5Dclose);
  if (note(static_cast<bool>(set), path)) text(path, "unit", std::string(column.unit));
  return set;
}

}  // namespace broadside::core
