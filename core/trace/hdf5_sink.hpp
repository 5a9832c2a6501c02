// Writes plain arrays, numbers and fixed-length strings into an open HDF5 file. Private to core/trace/*.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {

// Little-endian on disk, which is also how every machine that this builds for holds them.
hid_t hdf5_type(Element element);

// Size of the chunks that compressed arrays aim at: large enough for gzip to find repeats, small enough that HDF5's
// default chunk cache of 1 MiB per dataset holds several.
constexpr std::uint64_t kChunkBytes = std::uint64_t{128} * 1024;

// Rows first .. first + rows - 1 of a dataset; inner: its dimensions after the first, two at most.
bool put_rows(hid_t set, Element element, std::span<const std::uint64_t> inner, std::uint64_t first, std::uint64_t rows,
              const void* data);

// Keeps the first failure and then does nothing more: the caller writes everything and asks once.
class Hdf5Sink {
 public:
  explicit Hdf5Sink(hid_t file) : file_(file) {}

  void group(const std::string& path);
  // Attributes of the object at path. One value is a scalar, several are one dimension.
  void number(const std::string& path, const std::string& name, Element element, const void* values,
              std::size_t count = 1);
  void text(const std::string& path, const std::string& name, const std::string& value);
  // For readers that take no UTF-8.
  void ascii(const std::string& path, const std::string& name, const std::string& value);
  // An array of that many rows, whose values come later, with put_rows.
  Handle rows(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows,
              const std::string& unit);
  // A whole array at once, [rows] or [rows, width]. Shuffled and compressed when that is worth it.
  void array(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows, const void* data,
             const std::string& unit);
  // The same value in every row: it is the fill value, and no row is stored.
  void constant(const std::string& path, Element element, std::uint64_t rows, const void* value,
                const std::string& unit);
  // One fixed-length string per entry, padded with zeros to the longest.
  void texts(const std::string& path, const std::vector<std::string>& values, const std::string& unit);
  // An array that will grow along its first dimension, chunked. Missing steps read as the largest number.
  Handle growing(const Column& column, std::uint64_t bodies);

  [[nodiscard]] bool ok() const { return failed_at_.empty(); }
  [[nodiscard]] const std::string& failed_at() const { return failed_at_; }
  [[nodiscard]] hid_t file() const { return file_; }
  // Whether good; when it is not, path is where it failed first.
  bool note(bool good, const std::string& path);

 private:
  void text_of(const std::string& path, const std::string& name, const std::string& value, H5T_cset_t characters);

  hid_t file_;
  std::string failed_at_;
};

}  // namespace broadside::core
