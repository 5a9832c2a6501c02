#include "core/trace/group_block.hpp"

#include <cstring>
#include <string>

namespace broadside::core {
namespace {

// Frames are read ahead up to this many bytes: then reading a trace in order costs one HDF5 call per dataset for some
// 100 frames of 50 bodies.
constexpr std::uint64_t kBlockBytes = 4U << 20U;

std::vector<std::uint64_t> inner_dimensions(const Column& c, std::uint64_t bodies) {
  if (c.layout == Layout::kFrameBodies) return {bodies, c.width};
  return c.width == 1 ? std::vector<std::uint64_t>{} : std::vector<std::uint64_t>{c.width};
}

// A bool has two values, and reading any other byte as a bool is undefined: every byte that is not 0 becomes 1 first.
void normalize_flags(std::vector<std::byte>& flags) {
  for (std::byte& b : flags) b = b == std::byte{0} ? std::byte{0} : std::byte{1};
}

}  // namespace

GroupBlock::GroupBlock(Group group, std::uint64_t bodies, Hdf5Source& source) : group_(group) {
  for (const Column& c : columns()) {
    if (c.groups != bit(group) || c.layout == Layout::kWindows || c.layout == Layout::kOffsets) continue;
    if (c.is_optional && !source.has(std::string(c.path))) continue;
    columns_.push_back({&c, source.array(std::string(c.path), c.element, inner_dimensions(c, bodies)), {}});
  }
}

void GroupBlock::keep_reached(FrameIndex& index) const {
  for (const OpenColumn& open : columns_) core::keep_reached(index, *open.column, open.array);
}

std::uint64_t GroupBlock::frame_bytes(const FrameIndex& index, std::uint64_t frame) const {
  std::uint64_t sum = 0;
  for (const OpenColumn& open : columns_) {
    const std::uint64_t rows = index.rows_before(*open.column, frame + 1) - index.rows_before(*open.column, frame);
    sum += rows * open.array.row_bytes;
  }
  return sum;
}

bool GroupBlock::read_ahead(const FrameIndex& index, std::uint64_t frame, Hdf5Source& source) {
  std::uint64_t end = frame + 1;
  for (std::uint64_t bytes = frame_bytes(index, frame); end < index.frame_count(); ++end) {
    bytes += frame_bytes(index, end);
    if (bytes > kBlockBytes) break;
  }
  first_ = last_ = 0;
  for (OpenColumn& open : columns_) {
    const std::uint64_t begin = index.rows_before(*open.column, frame);
    const std::uint64_t rows = index.rows_before(*open.column, end) - begin;
    if (!source.read(open.array, std::string(open.column->path), begin, rows, open.rows)) return false;
    if (open.column->element == Element::kU8) normalize_flags(open.rows);
  }
  first_ = frame;
  last_ = end;
  return true;
}

void GroupBlock::take(const FrameIndex& index, const OpenColumn& open, std::uint64_t frame, FrameRecord& record) const {
  const Column& c = *open.column;
  const std::uint64_t begin = index.rows_before(c, frame);
  const std::uint64_t rows = index.rows_before(c, frame + 1) - begin;
  const std::size_t bytes = row_bytes(c);
  const std::uint64_t count = rows * open.array.row_bytes / bytes;
  const RecordSpan<std::byte> records = resized_records(record, c.records, count);
  if (count == 0) return;
  const std::byte* from = open.rows.data() + (begin - index.rows_before(c, first_)) * open.array.row_bytes;
  if (records.stride == bytes) {
    std::memcpy(records.data, from, count * bytes);
    return;
  }
  std::byte* to = records.data + c.offset;
  for (std::uint64_t i = 0; i < count; ++i, from += bytes, to += records.stride) std::memcpy(to, from, bytes);
}

bool GroupBlock::read(const FrameIndex& index, std::uint64_t frame, Hdf5Source& source, FrameRecord& record) {
  const bool is_ahead = frame >= first_ && frame < last_;
  if (!is_ahead && !read_ahead(index, frame, source)) return false;
  for (const OpenColumn& open : columns_) take(index, open, frame, record);
  return true;
}

}  // namespace broadside::core
