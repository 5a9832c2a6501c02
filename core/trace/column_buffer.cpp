#include "core/trace/column_buffer.hpp"

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
  if (column.layout == Layout::kOffsets) {  // offsets start with 0
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

bool ColumnBuffer::write() {
  if (rows_waiting_ == 0) return true;
  std::array<hsize_t, 3> extent{rows_written_ + rows_waiting_};
  std::array<hsize_t, 3> start{rows_written_};
  std::array<hsize_t, 3> count{rows_waiting_};
  for (std::size_t i = 0; i < inner_.size(); ++i) extent[i + 1] = count[i + 1] = inner_[i];
  const int rank = static_cast<int>(inner_.size()) + 1;
  if (H5Dset_extent(set_.get(), extent.data()) < 0) return false;
  rows_written_ += std::exchange(rows_waiting_, 0);
  if (waiting_.empty()) return true;  // a scene without bodies: frames of nothing
  const Handle there(H5Dget_space(set_.get()), H5Sclose);
  const Handle here(H5Screate_simple(rank, count.data(), nullptr), H5Sclose);
  const bool good =
      there && here &&
      H5Sselect_hyperslab(there.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0 &&
      H5Dwrite(set_.get(), hdf5_type(column_->element), here.get(), there.get(), H5P_DEFAULT, waiting_.data()) >= 0;
  waiting_.clear();
  return good;
}

}  // namespace broadside::core
