// Writes plain arrays, numbers and fixed-length strings into an open HDF5 file. Private to core/trace/*.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {

// Little-endian on disk, as in memory on every machine for which this is built.
hid_t hdf5_type(Element element);

// Target size of the chunks of compressed arrays: large enough for gzip to find repeats, and small enough that HDF5's
// default chunk cache of 1 MiB per dataset holds several.
constexpr std::uint64_t kChunkBytes = std::uint64_t{128} * 1024;

// Writes rows first .. first + rows - 1 of a dataset; inner: its dimensions after the first, at most two.
bool put_rows(hid_t set, Element element, std::span<const std::uint64_t> inner, std::uint64_t first, std::uint64_t rows,
              const void* data);

// Keeps the first failure and then does nothing more: the caller writes everything and checks once.
class Hdf5Sink {
 public:
  explicit Hdf5Sink(hid_t file) : file_(file) {}

  void group(const std::string& path);
  // Attributes of the object at path. One value is a scalar, several are one dimension.
  void number(const std::string& path, const std::string& name, Element element, const void* values,
              std::size_t count = 1);
  void text(const std::string& path, const std::string& name, const std::string& value);
  // For readers that do not accept UTF-8.
  void ascii(const std::string& path, const std::string& name, const std::string& value);
  // Creates an array with that many rows, whose values are written later, with put_rows.
  Handle rows(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows,
              const std::string& unit);
  // Writes a whole array at once, [rows] or [rows, width]. Shuffled and compressed when that is worthwhile.
  void array(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows, const void* data,
             const std::string& unit);
  // The same value in every row: it is stored as the fill value, and no row is stored.
  void constant(const std::string& path, Element element, std::uint64_t rows, const void* value,
                const std::string& unit);
  // One fixed-length string per entry, padded with zeros to the longest.
  void texts(const std::string& path, const std::vector<std::string>& values, const std::string& unit);
  // Creates a chunked array that will grow along its first dimension. Missing steps read as the largest number.
  Handle growing(const Column& column, std::uint64_t bodies);

  [[nodiscard]] bool ok() const { return failed_at_.empty(); }
  [[nodiscard]] const std::string& failed_at() const { return failed_at_; }
  [[nodiscard]] hid_t file() const { return file_; }
  // Returns `good`; at the first failure it keeps path.
  bool note(bool good, const std::string& path);

 private:
  void text_of(const std::string& path, const std::string& name, const std::string& value, H5T_cset_t characters);

  hid_t file_;
  std::string failed_at_;
};

}  // namespace broadside::core
