// The datasets of one Group of a trace that is being read, with a block of frames read ahead. Private to
// core/trace/*.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/trace/columns.hpp"
#include "core/trace/frame_index.hpp"
#include "core/trace/hdf5_source.hpp"

namespace broadside::core {

class GroupBlock {
 public:
  // Opens and checks every dataset of the group; reports to source what is missing or wrong.
  GroupBlock(Group group, std::uint64_t bodies, Hdf5Source& source);

  [[nodiscard]] Group group() const { return group_; }
  // Shortens index to the frames that every dataset reaches.
  void keep_reached(FrameIndex& index) const;
  // Fills the group's members of record. False when something is wrong; source then has the error.
  bool read(const FrameIndex& index, std::uint64_t frame, Hdf5Source& source, FrameRecord& record);

 private:
  struct OpenColumn {
    const Column* column;
    OpenArray array;
    std::vector<std::byte> rows;  // of frames first_ .. last_ - 1
  };

  [[nodiscard]] std::uint64_t frame_bytes(const FrameIndex& index, std::uint64_t frame) const;
  bool read_ahead(const FrameIndex& index, std::uint64_t frame, Hdf5Source& source);
  void take(const FrameIndex& index, const OpenColumn& open, std::uint64_t frame, FrameRecord& record) const;

  Group group_;
  std::vector<OpenColumn> columns_;
  std::uint64_t first_ = 0;
  std::uint64_t last_ = 0;
};

}  // namespace broadside::core
