// One search for pairs on the device: its memory, its launches and what they left. A broad phase alone is one of these,
// or where core/method/box_passes.hpp says so, one for each pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/method/box_passes.hpp"
#include "core/pair.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/broad/pair_finder_options.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"
#include "gpu/work/work_counter.hpp"

namespace broadside::gpu {

// The boxes of one search, on the host.
class SearchedBoxes {
 public:
  // All boxes as they are. An error names the first that is not finite or has min > max.
  core::Status take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                    const PairFinderOptions& options);
  // Those of a pass, in its coordinates. They are sound.
  void take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::PassPlan& plan,
            const core::BoxPass& pass);

  [[nodiscard]] const BoxFacts& facts() const { return facts_; }
  [[nodiscard]] std::span<const PackedBox> searched() const { return searched_; }
  // Empty where boxes are searched as they are; else as SettleView has them.
  [[nodiscard]] std::span<const PackedBox> given() const { return given_; }
  [[nodiscard]] std::uint32_t owned() const { return owned_; }

 private:
  void start();
  void add(const core::Box& box, bool is_static);
  void finish();

  std::vector<PackedBox> searched_;
  std::vector<PackedBox> given_;
  BoxFacts facts_;
  core::Box bounds_;
  std::uint32_t owned_ = 0;
};

class BoxSearch {
 public:
  // Memory for these boxes, and the boxes on the device. `is_new`: forget what a set before has left.
  core::Status load(const SearchedBoxes& boxes, const PairFinderOptions& options, bool is_new);

  core::Status launch(StreamHandle stream);
  // After the stream was waited for: whether pairs were lost; grow then makes room for them.
  [[nodiscard]] bool is_aborted() const { return outcome_[0].counters.is_aborted != 0; }
  core::Status grow();
  // What the search tests, where somebody asked.
  core::Status count_work(WorkCounter& work, StreamHandle stream);

  // The pairs of the last launch, behind those that are there.
  core::Status append_pairs(std::vector<core::Pair>& to) const;

  [[nodiscard]] const Outcome& outcome() const { return outcome_[0]; }
  [[nodiscard]] std::uint64_t launches() const { return shape_.bins != 0 ? 2 : 1; }
  [[nodiscard]] std::uint64_t bytes() const {
    return boxes_.bytes() + given_.bytes() + broad_.bytes() + pairs_.bytes() + settled_.bytes();
  }

 private:
  core::Status reserve(const SearchedBoxes& boxes, const PairFinderOptions& options);

  PairsShape shape_;
  PairsView view_;
  Start start_ = Start::kNone;
  std::uint32_t count_ = 0;
  Mapped<Outcome, 1> outcome_;
  BroadBuffers broad_;
  DeviceBuffer<PackedBox> boxes_;
  DeviceBuffer<PackedBox> given_;
  DeviceBuffer<core::Pair> pairs_;
  DeviceBuffer<core::Pair> settled_;
  DeviceBuffer<Counters> counters_;
  DeviceBuffer<unsigned long long> barrier_;
};

}  // namespace broadside::gpu
