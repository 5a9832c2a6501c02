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
constexpr std::uint64_t kChunkBytes = 128 * 1024;

// Keeps the first failure and then does nothing more: the caller writes everything and asks once.
class Hdf5Sink {
 public:
  explicit Hdf5Sink(hid_t file) : file_(file) {}

  void group(const std::string& path);
  // Attributes of the object at path. One value is a scalar, several are one dimension.
  void number(const std::string& path, const std::string& name, Element element, const void* values,
              std::size_t count = 1);
  void text(const std::string& path, const std::string& name, const std::string& value);
  // A whole array at once, [rows] or [rows, width]. Shuffled and compressed when it is larger than a chunk.
  void array(const std::string& path, Element element, std::uint32_t width, std::uint64_t rows, const void* data,
             const std::string& unit);
  // One fixed-length string per entry, padded with zeros to the longest.
  void texts(const std::string& path, const std::vector<std::string>& values, const std::string& unit);
  // An array that will grow along its first dimension, chunked. Missing steps read as the largest number.
  Handle growing(const Column& column, std::uint64_t bodies);

  [[nodiscard]] bool ok() const { return failed_at_.empty(); }
  [[nodiscard]] const std::string& failed_at() const { return failed_at_; }

 private:
  bool note(bool good, const std::string& path);

  hid_t file_;
  std::string failed_at_;
};

}  // namespace broadside::core
