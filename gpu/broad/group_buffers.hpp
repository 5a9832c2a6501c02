// Device memory of a search by groups of neighboring boxes.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/broad/grouped_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

class GroupBuffers {
 public:
  core::Status load(const BoxFacts& facts);
  // Takes the facts that a new set of boxes may change.
  void refit(const BoxFacts& facts);
  // Makes room for this many pairs of groups. Returns false if there are so many that a search by cells is faster.
  core::Result<bool> grow(std::uint64_t group_pairs);
  [[nodiscard]] GroupView view() const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  GroupView view_;
  std::uint64_t most_groups_ = 0;
  DeviceBuffer<std::uint32_t> count_;
  DeviceBuffer<std::uint32_t> begin_;
  DeviceBuffer<std::uint32_t> rank_;
  DeviceBuffer<std::uint32_t> chunk_room_;  // and entry_count
  DeviceBuffer<PackedBox> entries_;
  DeviceBuffer<PackedBox> groups_;
  DeviceBuffer<PackedBox> clusters_;
  DeviceBuffer<core::Pair> group_pairs_;
};

}  // namespace broadside::gpu
