// Reads plain arrays, numbers and fixed-length strings from an HDF5 file that is not trusted. Private to
// core/trace/*.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {

// A dataset whose type and rank were checked. rows is its first dimension.
struct OpenArray {
  Handle set;
  Element element = Element::kU8;
  std::uint64_t rows = 0;
  std::uint64_t row_bytes = 0;  // the bytes of one row: the product of the other dimensions and the element's size
  std::vector<hsize_t> dims;
};

// Keeps the first failure and then returns empty values: the caller reads everything and checks once.
class Hdf5Source {
 public:
  // A finished file, or one that a writer left or is still writing.
  static Result<Hdf5Source> open(const std::filesystem::path& path);

  // Whether the object exists in this very file. A link to another file does not count, since following it would
  // present that file's content as this one's.
  [[nodiscard]] bool has(const std::string& path) const;
  [[nodiscard]] bool has_attribute(const std::string& path, const std::string& name) const;
  std::vector<std::string> attribute_names(const std::string& path);

  template <typename T>
  T number(const std::string& path, const std::string& name) {
    T value{};
    numbers(path, name, element_of<T>(), &value, 1);
    return value;
  }
  void numbers(const std::string& path, const std::string& name, Element element, void* values, std::size_t count);
  std::string text(const std::string& path, const std::string& name);

  // Whether the object is a dataset of these elements; false for anything else.
  bool has_elements(const std::string& path, Element element);
  // Dimensions of the dataset; empty when there is none; array() then reports the error.
  std::vector<std::uint64_t> shape(const std::string& path);
  // Dimensions after the first must be these; none = a plain list.
  OpenArray array(const std::string& path, Element element, const std::vector<std::uint64_t>& inner);
  // Reads count rows, from first on, into out.
  bool read(const OpenArray& array, const std::string& path, std::uint64_t first, std::uint64_t count,
            std::vector<std::byte>& out);
  template <typename T>
  std::vector<T> whole(const std::string& path, Element element, std::uint32_t width) {
    const OpenArray a =
        array(path, element, width == 1 ? std::vector<std::uint64_t>{} : std::vector<std::uint64_t>{width});
    std::vector<T> values;
    if (!ok()) return values;
    values.resize(a.rows * a.row_bytes / sizeof(T));
    read_into(a, path, 0, a.rows, reinterpret_cast<std::byte*>(values.data()));
    return values;
  }
  std::vector<std::string> texts(const std::string& path);

  void close() { file_.close(); }
  // Only the first failure is kept.
  void fail(const std::string& at, const std::string& what, const std::string& advice);
  [[nodiscard]] bool ok() const { return !error_; }
  [[nodiscard]] const Error& error() const { return *error_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // True when its writer was killed or is still at work.
  [[nodiscard]] bool was_left_open() const { return was_left_open_; }

 private:
  template <typename T>
  static constexpr Element element_of() {
    if constexpr (sizeof(T) == 1)
      return Element::kU8;
    else if constexpr (std::is_floating_point_v<T>)
      return sizeof(T) == 4 ? Element::kF32 : Element::kF64;
    else
      return sizeof(T) == 4 ? Element::kU32 : Element::kU64;
  }
  Hdf5Source(Handle file, std::filesystem::path path, std::uint64_t file_bytes, bool was_left_open)
      : file_(std::move(file)), path_(std::move(path)), file_bytes_(file_bytes), was_left_open_(was_left_open) {}
  bool read_into(const OpenArray& array, const std::string& path, std::uint64_t first, std::uint64_t count,
                 std::byte* out);
  void fail_hdf5(const std::string& at, const std::string& what);
  // Whether the dataset is stored in this file, by known means, and with a size that the file can hold. If not, the
  // failure says which of these is wrong.
  bool can_hold(hid_t set, const std::string& path, const std::vector<hsize_t>& dims, std::uint64_t element_bytes);

  Handle file_;
  std::filesystem::path path_;
  std::uint64_t file_bytes_ = 0;
  bool was_left_open_ = false;
  std::optional<Error> error_;
};

}  // namespace broadside::core
