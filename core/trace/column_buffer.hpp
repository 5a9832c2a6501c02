// One growing dataset of /trace while it is written: rows wait in memory until a call to HDF5 is worth its cost.
// Private to core/trace/*.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {

enum class Packing : std::uint8_t {
  kSmall,  // through HDF5's filters
  kFast,   // whole chunks as they are: HDF5 marks each chunk with the filters that it skipped, so readers see no
           // difference
};

class ColumnBuffer {
 public:
  ColumnBuffer(const Column& column, std::uint64_t bodies, Handle set);

  [[nodiscard]] const Column& column() const { return *column_; }
  [[nodiscard]] const Handle& set() const { return set_; }
  [[nodiscard]] std::size_t waiting_bytes() const { return waiting_.size(); }

  // Adds one frame (or window): the column's part of each record; for offsets, the number of records so far.
  void add(RecordSpan<const std::byte> records);
  // Passes the waiting rows to HDF5. False when HDF5 failed; the reason is then on HDF5's error stack.
  bool write(Packing packing);

 private:
  // Precondition: rows first .. first + count - 1 are whole chunks.
  bool store_chunks(std::uint64_t first, std::uint64_t count, const std::byte* from);

  const Column* column_;
  Handle set_;
  std::vector<std::uint64_t> inner_;  // dimensions after the first
  std::vector<hsize_t> chunk_;        // chunk size in each dimension
  std::uint64_t bytes_per_row_;
  std::uint64_t rows_written_ = 0;
  std::uint64_t rows_waiting_ = 0;
  std::uint64_t total_records_ = 0;
  std::vector<std::byte> waiting_;
  std::vector<std::byte> padded_;  // a chunk at the edge of the array
};

}  // namespace broadside::core
