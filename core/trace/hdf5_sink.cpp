#include "core/trace/hdf5_sink.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace broadside::core {
namespace {

// Fixed length, padded with zeros. HDF5 has no string of length 0.
Handle text_type(std::size_t length, H5T_cset_t characters = H5T_CSET_UTF8) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(length, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), characters);
  return type;
}

// Smaller arrays are stored uncompressed: a chunk index would cost more than gzip saves.
constexpr std::uint64_t kLeastPackedBytes = 4096;

bool write_attribute(hid_t object, const std::string& name, hid_t type, const Handle& space, const void* data) {
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute.get(), type, data) >= 0;
}

// Shuffle + gzip 1, and no timestamps in object headers, so that equal traces are equal files as far as HDF5 allows.
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
    case Element::kI64:
      return H5T_STD_I64LE;
    case Element::kF32:
      return H5T_IEEE_F32LE;
    case Element::kF64:
      return H5T_IEEE_F64LE;
  }
  return H5I_INVALID_HID;
}

bool put_rows(hid_t set, Element element, std::span<const std::uint64_t> inner, std::uint64_t first, std::uint64_t rows,
              const void* data) {
  if (rows == 0) return true;
  std::array<hsize_t, 3> start{first};
  std::array<hsize_t, 3> count{rows};
  for (std::size_t i = 0; i < inner.size(); ++i) count[i + 1] = inner[i];
  const Handle there(H5Dget_space(set), H5Sclose);
  const Handle here(H5Screate_simple(static_cast<int>(inner.size()) + 1, count.data(), nullptr), H5Sclose);
  return there && here &&
         H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
         H5Dwrite(set, hdf5_type(element), here.get(), there.get(), H5P_DEFAULT, data) >= 0;
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
  text_of(path, name, value, H5T_CSET_UTF8);
}

void Hdf5Sink::ascii(const std::string& path, const std::string& name, const std::string& value) {
  text_of(path, name, value, H5T_CSET_ASCII);
}

void Hdf5Sink::text_of(const std::string& path, const std::string& name, const std::string& value,
                       H5T_cset_t characters) {
  if (!ok()) return;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type = text_type(value.size(), characters);
  note(object && write_attribute(object.get(), name, type.get(), space, value.c_str()), path + "@" + name);
}

Handle Hdf5Sink::rows(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows,
                      const std::string& unit) {
  if (!ok()) return {};
  const hsize_t dims[2] = {rows, width};
  const std::size_t rank = width == 1 ? 1 : 2;
  const std::uint64_t bytes_per_row = width * size_of(element);
  const hsize_t chunk[2] = {std::clamp<hsize_t>(kChunkBytes / bytes_per_row, 1, std::max<hsize_t>(rows, 1)), width};
  const bool compress = rows * bytes_per_row > kLeastPackedBytes;
  const Handle properties = creation_properties(std::span(chunk, compress ? rank : 0));
  const Handle space(H5Screate_simple(static_cast<int>(rank), dims, nullptr), H5Sclose);
  Handle set(
      H5Dcreate2(file_, path.c_str(), hdf5_type(element), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose);
  if (note(static_cast<bool>(set), path)) text(path, "unit", unit);
  return set;
}

void Hdf5Sink::array(const std::string& path, Element element, std::uint32_t width, std::uint64_t row_count,
                     const void* data, const std::string& unit) {
  const Handle set = rows(path, element, width, row_count, unit);
  if (set && row_count > 0)
    note(H5Dwrite(set.get(), hdf5_type(element), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, path);
}

void Hdf5Sink::constant(const std::string& path, Element element, std::uint64_t rows, const void* value,
                        const std::string& unit) {
  if (!ok()) return;
  const hsize_t dims = rows;
  const Handle properties = creation_properties({});
  H5Pset_fill_value(properties.get(), hdf5_type(element), value);
  H5Pset_alloc_time(properties.get(), H5D_ALLOC_TIME_LATE);
  const Handle space(H5Screate_simple(1, &dims, nullptr), H5Sclose);
  const Handle set(
      H5Dcreate2(file_, path.c_str(), hdf5_type(element), space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
      H5Dclose);
  if (note(static_cast<bool>(set), path)) text(path, "unit", unit);
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
  // [F, n, width], or [F] / [F, width]. A fixed dimension of 0 cannot be chunked, so zero bodies get room for one.
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
