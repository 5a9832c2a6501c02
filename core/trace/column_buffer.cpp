#include "core/trace/column_buffer.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/trace/hdf5_sink.hpp"

namespace broadside::core {

ColumnBuffer::ColumnBuffer(const Column& column, std::uint64_t bodies, Handle set)
    : column_(&column), set_(std::move(set)), bytes_per_row_(row_bytes(column)) {
  if (column.layout == Layout::kFrameBodies) {
    inner_ = {bodies, column.width};
    bytes_per_row_ *= bodies;
  } else if (column.width != 1) {
    inner_ = {column.width};
  }
  const Handle properties(H5Dget_create_plist(set_.get()), H5Pclose);
  chunk_.assign(inner_.size() + 1, 1);
  if (properties) H5Pget_chunk(properties.get(), static_cast<int>(chunk_.size()), chunk_.data());
  if (column.layout == Layout::kOffsets) {  // the first offset is 0
    waiting_.resize(sizeof(std::uint64_t));
    rows_waiting_ = 1;
  }
}

void ColumnBuffer::add(RecordSpan<const std::byte> records) {
  total_records_ += records.count;
  rows_waiting_ += column_->layout == Layout::kRows ? records.count : 1;
  const std::size_t at = waiting_.size();
  if (column_->layout == Layout::kOffsets) {
    waiting_.resize(at + sizeof total_records_);
    std::memcpy(&waiting_[at], &total_records_, sizeof total_records_);
    return;
  }
  if (records.count == 0) return;
  const std::size_t bytes = row_bytes(*column_);
  if (records.stride == bytes) {
    waiting_.insert(waiting_.end(), records.data, records.data + records.count * bytes);
    return;
  }
  waiting_.resize(at + records.count * bytes);
  const std::byte* from = records.data + column_->offset;
  std::byte* to = &waiting_[at];
  for (std::size_t i = 0; i < records.count; ++i, from += records.stride, to += bytes) std::memcpy(to, from, bytes);
}

bool ColumnBuffer::write(Packing packing) {
  if (rows_waiting_ == 0) return true;
  const std::uint64_t first = rows_written_;
  const std::uint64_t count = std::exchange(rows_waiting_, 0);
  std::array<hsize_t, 3> extent{first + count};
  for (std::size_t i = 0; i < inner_.size(); ++i) extent[i + 1] = inner_[i];
  if (H5Dset_extent(set_.get(), extent.data()) < 0) return false;
  rows_written_ += count;
  if (waiting_.empty()) return true;  // a scene without bodies: its frames have no bytes
  // Rows before the first whole chunk, the whole chunks, and the rows after them.
  std::uint64_t head = count;
  std::uint64_t whole = 0;
  if (packing == Packing::kFast) {
    const std::uint64_t begin = (first + chunk_[0] - 1) / chunk_[0] * chunk_[0];
    const std::uint64_t end = (first + count) / chunk_[0] * chunk_[0];
    if (begin < end) {
      head = begin - first;
      whole = end - begin;
    }
  }
  const auto write_some = [this](std::uint64_t row, std::uint64_t rows, const std::byte* data) {
    return put_rows(set_.get(), column_->element, inner_, row, rows, data);
  };
  const std::byte* from = waiting_.data();
  const bool good = write_some(first, head, from) && store_chunks(first + head, whole, from + head * bytes_per_row_) &&
                    write_some(first + head + whole, count - head - whole, from + (head + whole) * bytes_per_row_);
  waiting_.clear();
  return good;
}

// Only the second dimension, bodies, can be longer than its chunk.
bool ColumnBuffer::store_chunks(std::uint64_t first, std::uint64_t count, const std::byte* from) {
  constexpr std::uint32_t kSkipAllFilters = 0x3;  // shuffle and gzip
  const std::uint64_t bytes_per_entry = inner_.empty() ? bytes_per_row_ : bytes_per_row_ / inner_[0];
  const std::uint64_t across = inner_.empty() ? 1 : inner_[0];
  const std::uint64_t chunk_across = inner_.empty() ? 1 : chunk_[1];
  const std::uint64_t chunk_bytes = chunk_[0] * chunk_across * bytes_per_entry;
  for (std::uint64_t row = 0; row < count; row += chunk_[0]) {
    for (std::uint64_t at = 0; at < across; at += chunk_across) {
      const std::byte* chunk = from + row * bytes_per_row_;
      if (chunk_across != across) {
        padded_.assign(chunk_bytes, std::byte{0});
        const std::uint64_t bytes = std::min(chunk_across, across - at) * bytes_per_entry;
        for (std::uint64_t r = 0; r < chunk_[0]; ++r)
          std::memcpy(&padded_[r * chunk_across * bytes_per_entry],
                      from + (row + r) * bytes_per_row_ + at * bytes_per_entry, bytes);
        chunk = padded_.data();
      }
      const std::array<hsize_t, 3> offset{first + row, at, 0};
      if (H5Dwrite_chunk(set_.get(), H5P_DEFAULT, kSkipAllFilters, offset.data(), chunk_bytes, chunk) < 0) return false;
    }
  }
  return true;
}

}  // namespace broadside::core
