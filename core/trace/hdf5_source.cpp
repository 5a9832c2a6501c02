#include "core/trace/hdf5_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/trace/check_attributes.hpp"
#include "core/trace/hdf5_sink.hpp"
#include "core/trace/page_journal.hpp"

namespace broadside::core {
namespace {

constexpr const char* kNotOurs = "give a trace that follows core/trace/SCHEMA.md";
constexpr std::size_t kLongestText = 1U << 20U;  // 1 MiB: settings and notes are a few hundred bytes

// Deflate's best ratio is 1032:1 (258 bytes for 2 bits): no valid array is larger than that many times its file.
constexpr std::uint64_t kBestRatio = 1032;

// A chunk is held in memory as a whole, even to read a single row of it. HDF5 writes and recommends about 1 MiB.
constexpr std::uint64_t kLargestChunk = 256U << 20U;

// Exactly the IEEE or integer type, in either byte order. A type of the same size with another meaning is refused
// rather than converted.
bool is_type(hid_t type, Element element) {
  const hid_t wanted = hdf5_type(element);
  if (H5Tequal(type, wanted) > 0) return true;
  const Handle swapped(H5Tcopy(wanted), H5Tclose);
  return H5Tset_order(swapped.get(), H5T_ORDER_BE) >= 0 && H5Tequal(type, swapped.get()) > 0;
}

const char* name_of(Element e) {
  switch (e) {
    case Element::kU8:
      return "u8";
    case Element::kU32:
      return "u32";
    case Element::kU64:
      return "u64";
    case Element::kI64:
      return "i64";
    case Element::kF32:
      return "f32";
    case Element::kF64:
      return "f64";
  }
  return "?";
}

std::string shape_text(const std::vector<hsize_t>& dims) {
  std::string text = "[";
  for (std::size_t i = 0; i < dims.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(dims[i]);
  return text + "]";
}

herr_t take_name(hid_t /*object*/, const char* name, const H5A_info_t* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

Handle open_file(const std::filesystem::path& path, unsigned flags) {
  const Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(properties.get(), 0, 1);  // a reader must not block a writer
  // While a writer is at work, HDF5 rereads what fails its checksum, and doubles the wait before each try, from 1 ns
  // on. Its default of 100 tries never ends on a damaged superblock; 20 tries wait for 1 ms, in which a write of a few
  // KiB finishes.
  H5Pset_metadata_read_attempts(properties.get(), 20);
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY | flags, properties.get()), H5Fclose};
}

bool is_in_this_file(hid_t file, const std::string& path) {
  H5L_info_t link{};
  return H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0 && H5Lget_info(file, path.c_str(), &link, H5P_DEFAULT) >= 0 &&
         link.type == H5L_TYPE_HARD;
}

bool multiply(const std::vector<hsize_t>& factors, std::uint64_t& product) {
  for (const hsize_t f : factors)
    if (f != 0 && __builtin_mul_overflow(product, f, &product)) return false;
  return true;
}

// Accepts only the filters that traces use, and none from a plugin: a filter is code that would run on untrusted bytes.
bool has_known_filters(hid_t properties) {
  const int count = H5Pget_nfilters(properties);
  for (int k = 0; k < count; ++k) {
    unsigned flags = 0;
    unsigned configuration = 0;
    std::size_t values = 0;
    const H5Z_filter_t id =
        H5Pget_filter2(properties, static_cast<unsigned>(k), &flags, &values, nullptr, 0, nullptr, &configuration);
    if (id != H5Z_FILTER_SHUFFLE && id != H5Z_FILTER_DEFLATE && id != H5Z_FILTER_FLETCHER32) return false;
  }
  return count >= 0;
}

// What a dataset says about its storage; checked before any of its values is read.
struct Storage {
  std::string fault;  // empty: it can be read
  std::string advice;
  // The largest size to which this much stored data can decompress.
  std::uint64_t most_bytes = 0;
};

Storage storage_of(hid_t set, std::uint64_t element_bytes, std::uint64_t file_bytes) {
  const Handle properties(H5Dget_create_plist(set), H5Pclose);
  const H5D_layout_t layout = properties ? H5Pget_layout(properties.get()) : H5D_LAYOUT_ERROR;
  // External storage and virtual datasets would read other files.
  if (layout == H5D_VIRTUAL || !properties || H5Pget_external_count(properties.get()) != 0)
    return {"its values lie in another file", kNotOurs, 0};
  if (layout != H5D_CHUNKED) return {"", "", file_bytes};
  if (!has_known_filters(properties.get()))
    return {"it is stored through a filter that is neither shuffle, gzip nor a checksum",
            "store it with gzip, or without a filter", 0};
  std::vector<hsize_t> chunk(H5S_MAX_RANK, 0);
  const int rank = H5Pget_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
  chunk.resize(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  std::uint64_t bytes = element_bytes;
  if (rank <= 0 || !multiply(chunk, bytes) || bytes > kLargestChunk)
    return {"its chunks are larger than 256 MiB", "store it in smaller chunks", 0};
  std::uint64_t most = 0;
  if (__builtin_mul_overflow(file_bytes, kBestRatio, &most)) most = ~std::uint64_t{0};
  return {"", "", most};
}

}  // namespace

Result<Hdf5Source> Hdf5Source::open(const std::filesystem::path& path) {
  struct stat status {};
  const std::string where = path.string();
  if (path.extension() == ".part")
    if (Status finished = finish_from_journal(path); !finished) return finished.error();
  if (stat(path.c_str(), &status) != 0) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    return Error{
        missing ? "there is no such file" : "it cannot be opened (" + std::system_category().message(errno) + ")",
        where, "check the path"};
  }
  if (!S_ISREG(status.st_mode)) return Error{"it is not a file", where, "give the path of a trace file"};
  if (access(path.c_str(), R_OK) != 0)
    return Error{"it cannot be read (" + std::system_category().message(errno) + ")", where, "change its permissions"};
  if (Status fits = check_attributes(path); !fits) return fits.error();
  Handle file = open_file(path, 0);
  // A writer that was killed leaves its mark in the file; a writer that is still at work has set it too.
  const bool was_left_open = !file;
  if (was_left_open) file = open_file(path, H5F_ACC_SWMR_READ);
  if (!file) {
    if (H5Fis_hdf5(path.c_str()) > 0)
      return hdf5_error("it is a damaged HDF5 file, or was cut off before its first frame", where, "record it again");
    hdf5_reason();
    return Error{"it is not an HDF5 file", where, "give a trace file as broadside run --record writes it"};
  }
  return Hdf5Source(std::move(file), path, static_cast<std::uint64_t>(status.st_size), was_left_open);
}

void Hdf5Source::fail(const std::string& at, const std::string& what, const std::string& advice) {
  if (!error_) error_ = Error{what, path_.string() + ": " + at, advice};
}

void Hdf5Source::fail_hdf5(const std::string& at, const std::string& what) {
  if (!error_) error_ = hdf5_error(what, path_.string() + ": " + at, "the file is damaged: record it again");
}

bool Hdf5Source::has(const std::string& path) const {
  if (path == "/") return true;
  // Checked parent by parent: HDF5 fails, rather than returning false, when a parent is missing.
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (!is_in_this_file(file_.get(), path.substr(0, slash))) return false;
  return is_in_this_file(file_.get(), path);
}

bool Hdf5Source::has_attribute(const std::string& path, const std::string& name) const {
  return has(path) && H5Aexists_by_name(file_.get(), path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Hdf5Source::attribute_names(const std::string& path) {
  std::vector<std::string> names;
  if (!ok()) return names;
  hsize_t at = 0;
  const herr_t code =
      H5Aiterate_by_name(file_.get(), path.c_str(), H5_INDEX_NAME, H5_ITER_INC, &at, take_name, &names, H5P_DEFAULT);
  if (code < 0) fail_hdf5(path, "its attributes cannot be listed");
  return names;
}

void Hdf5Source::numbers(const std::string& path, const std::string& name, Element element, void* values,
                         std::size_t count) {
  if (!ok()) return;
  const std::string at = path + "@" + name;
  if (!has_attribute(path, name)) return fail(at, "it is missing", kNotOurs);
  const Handle attribute(H5Aopen_by_name(file_.get(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute) return fail_hdf5(at, "it cannot be opened");
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!is_type(type.get(), element)) return fail(at, std::string("it is not of type ") + name_of(element), kNotOurs);
  if (H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(count) ||
      H5Sget_simple_extent_ndims(space.get()) > 1)
    return fail(at, "it does not hold " + std::to_string(count) + " value(s)", kNotOurs);
  if (H5Aread(attribute.get(), hdf5_type(element), values) < 0) fail_hdf5(at, "it cannot be read");
}

std::string Hdf5Source::text(const std::string& path, const std::string& name) {
  if (!ok()) return {};
  const std::string at = path + "@" + name;
  if (!has_attribute(path, name)) return fail(at, "it is missing", kNotOurs), std::string();
  const Handle attribute(H5Aopen_by_name(file_.get(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute) return fail_hdf5(at, "it cannot be opened"), std::string();
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    return fail(at, "it is not one fixed-length string", "store it as numpy.bytes_, not str"), std::string();
  const std::size_t length = H5Tget_size(type.get());
  if (length > kLongestText) return fail(at, "it is longer than 1 MiB", kNotOurs), std::string();
  std::string value(length, '\0');
  if (H5Aread(attribute.get(), type.get(), value.data()) < 0) return fail_hdf5(at, "it cannot be read"), std::string();
  return value.substr(0, value.find('\0'));
}

bool Hdf5Source::can_hold(hid_t set, const std::string& path, const std::vector<hsize_t>& dims,
                          std::uint64_t element_bytes) {
  const Storage storage = storage_of(set, element_bytes, file_bytes_);
  std::uint64_t bytes = element_bytes;
  if (!storage.fault.empty())
    fail(path, storage.fault, storage.advice);
  else if (!multiply(dims, bytes) || bytes > storage.most_bytes)
    fail(path,
         "its shape " + shape_text(dims) + " cannot come from a file of " + std::to_string(file_bytes_) + " bytes",
         "the file is damaged: record it again");
  return ok();
}

std::vector<std::uint64_t> Hdf5Source::shape(const std::string& path) {
  if (!ok() || !has(path)) return {};
  const Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) return {};
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank <= 0) return {};
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

bool Hdf5Source::has_elements(const std::string& path, Element element) {
  if (!ok() || !has(path)) return false;
  const Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) return false;
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  return is_type(type.get(), element);
}

OpenArray Hdf5Source::array(const std::string& path, Element element, const std::vector<std::uint64_t>& inner) {
  OpenArray a;
  if (!ok()) return a;
  if (!has(path)) return fail(path, "it is missing", kNotOurs), OpenArray();
  a.set = Handle(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!a.set) return fail_hdf5(path, "it cannot be opened as a dataset"), OpenArray();
  const Handle type(H5Dget_type(a.set.get()), H5Tclose);
  const Handle space(H5Dget_space(a.set.get()), H5Sclose);
  if (!is_type(type.get(), element))
    return fail(path, std::string("its elements are not ") + name_of(element), kNotOurs), OpenArray();
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (H5Sget_simple_extent_type(space.get()) != H5S_SIMPLE || rank != static_cast<int>(inner.size()) + 1)
    return fail(path, "it has " + std::to_string(rank) + " dimensions, not " + std::to_string(inner.size() + 1),
                kNotOurs),
           OpenArray();
  a.dims.resize(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.get(), a.dims.data(), nullptr);
  a.element = element;
  a.rows = a.dims[0];
  a.row_bytes = size_of(element);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (a.dims[i + 1] != inner[i])
      return fail(path,
                  "its shape " + shape_text(a.dims) + " should have " + std::to_string(inner[i]) + " in dimension " +
                      std::to_string(i + 1),
                  kNotOurs),
             OpenArray();
    a.row_bytes *= inner[i];
  }
  if (!can_hold(a.set.get(), path, a.dims, size_of(element))) return OpenArray();
  return a;
}

bool Hdf5Source::read_into(const OpenArray& array, const std::string& path, std::uint64_t first, std::uint64_t count,
                           std::byte* out) {
  if (!ok()) return false;
  if (count == 0 || array.row_bytes == 0) return true;
  std::vector<hsize_t> start(array.dims.size(), 0);
  std::vector<hsize_t> size = array.dims;
  start[0] = first;
  size[0] = count;
  const Handle there(H5Dget_space(array.set.get()), H5Sclose);
  const Handle here(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
  const bool good =
      there && here &&
      H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr) >= 0 &&
      H5Dread(array.set.get(), hdf5_type(array.element), here.get(), there.get(), H5P_DEFAULT, out) >= 0;
  if (!good)
    fail_hdf5(path, "rows " + std::to_string(first) + " to " + std::to_string(first + count - 1) + " cannot be read");
  return good;
}

bool Hdf5Source::read(const OpenArray& array, const std::string& path, std::uint64_t first, std::uint64_t count,
                      std::vector<std::byte>& out) {
  out.resize(count * array.row_bytes);
  return read_into(array, path, first, count, out.data());
}

std::vector<std::string> Hdf5Source::texts(const std::string& path) {
  std::vector<std::string> values;
  if (!ok()) return values;
  if (!has(path)) return fail(path, "it is missing", kNotOurs), values;
  const Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) return fail_hdf5(path, "it cannot be opened as a dataset"), values;
  const Handle type(H5Dget_type(set.get()), H5Tclose);
  const Handle space(H5Dget_space(set.get()), H5Sclose);
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      H5Sget_simple_extent_ndims(space.get()) != 1)
    return fail(path, "it is not a list of fixed-length strings", "store it as numpy bytes, not str"), values;
  const std::size_t length = H5Tget_size(type.get());
  hsize_t count = 0;
  H5Sget_simple_extent_dims(space.get(), &count, nullptr);
  if (length > kLongestText) return fail(path, "its strings are longer than 1 MiB", kNotOurs), values;
  if (!can_hold(set.get(), path, {count}, length)) return values;
  std::vector<char> padded(length * count);
  if (count > 0 && H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0)
    return fail_hdf5(path, "it cannot be read"), values;
  for (std::size_t i = 0; i < count; ++i)
    values.emplace_back(&padded[i * length], strnlen(&padded[i * length], length));
  return values;
}

}  // namespace broadside::core
