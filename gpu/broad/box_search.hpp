// One search for pairs on the device: its memory, its launches and their result. A broad phase that runs alone consists
// of one search or, where core/method/box_passes.hpp makes passes, of one for each pass.
#pragma once

#include <cstdint>
#include <vector>

#include "core/pair.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/broad/group_buffers.hpp"
#include "gpu/broad/named_pairs_view.hpp"
#include "gpu/broad/pair_finder_options.hpp"
#include "gpu/broad/searched_boxes.hpp"
#include "gpu/broad/settle_view.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"
#include "gpu/work/work_counter.hpp"

namespace broadside::gpu {

// The pairs that the last launches found, on the device.
struct FoundPairs {
  const core::Pair* data = nullptr;
  std::uint64_t count = 0;
};

class BoxSearch {
 public:
  // Reserves memory for these boxes and copies them to the device. `is_new`: forgets what an earlier set has left.
  core::Status load(const SearchedBoxes& boxes, const PairFinderOptions& options, bool is_new);

  // The same for boxes that are packed on the device: room_for() says where to put them, then load_packed() takes them.
  core::Result<PackedBox*> room_for(std::size_t boxes);
  core::Status load_packed(const BoxFacts& facts, const PairFinderOptions& options, bool is_new);

  // As room_for(), but the memory may move: the first `kept` boxes are copied there.
  core::Result<PackedBox*> move_to_room_for(std::size_t boxes, std::size_t kept, StreamHandle stream);

  // After load_packed(), if the boxes are in the coordinates of a pass: room_for_given() returns where to put the boxes
  // as given, and the first `kept` of them stay; settle_on_given() says which groups' pairs are kept (SettleView).
  core::Result<PackedBox*> room_for_given(std::size_t boxes, std::size_t kept, StreamHandle stream);
  core::Status settle_on_given(std::uint32_t owned, const PairFinderOptions& options);

  core::Status launch(StreamHandle stream);
  // If the options have shares: searches one. `share`: names, places, and whether the boxes are in order already.
  core::Status launch_share(const NamedPairsView& share, StreamHandle stream);
  [[nodiscard]] bool can_share() const { return start_ == Start::kBulk; }
  [[nodiscard]] Start start() const { return start_; }
  // Whether the search is by groups of neighboring boxes; it no longer is once the groups had too many pairs.
  [[nodiscard]] bool is_grouped() const { return is_grouped_; }
  [[nodiscard]] std::uint32_t lanes_per_box() const { return lanes_per_box_; }
  [[nodiscard]] std::uint32_t box_count() const { return count_; }
  [[nodiscard]] std::uint32_t multiprocessors() const { return shape_.search.multiprocessors; }
  // After a search of shares: the view with its result on the device.
  [[nodiscard]] const PairsView& view() const { return view_; }
  // Valid once the stream was waited for. Whether pairs were lost for want of room; grow() then makes room for them.
  [[nodiscard]] bool is_aborted() const { return outcome_[0].counters.is_aborted != 0; }
  core::Status grow();
  void forget_abort() { outcome_[0].counters.is_aborted = 0; }
  // Counts what the search tests, if `work` was asked to count.
  core::Status count_work(WorkCounter& work, StreamHandle stream);

  [[nodiscard]] FoundPairs found() const;
  [[nodiscard]] std::uint64_t room_for_pairs() const { return is_settled() ? settled_.capacity() : pairs_.capacity(); }
  // How much of the room for pairs the last launch needed: above 1, there was too little. For a pass, found pairs and
  // kept pairs have rooms of their own, and the larger of the two shares is returned.
  [[nodiscard]] double fullness() const;
  // Appends the pairs of the last launch.
  core::Status append_pairs(std::vector<core::Pair>& to) const;

  [[nodiscard]] const Outcome& outcome() const { return outcome_[0]; }
  [[nodiscard]] std::uint64_t launches() const {
    return (!is_grouped_ && shape_.bins.bins != 0 ? 2U : 1U) + (is_settled() ? 1U : 0U);
  }
  [[nodiscard]] std::uint64_t bytes() const {
    return boxes_.bytes() + given_.bytes() + broad_.bytes() + groups_.bytes() + pairs_.bytes() + settled_.bytes();
  }

 private:
  [[nodiscard]] bool is_settled() const { return settle_.given != nullptr; }
  [[nodiscard]] bool wants_groups(const BoxFacts& facts) const {
    return facts.fit.is_grouped && can_share() && !has_too_many_group_pairs_;
  }
  core::Status reserve(const BoxFacts& facts, const PairFinderOptions& options);
  [[nodiscard]] std::uint64_t first_room(const PairFinderOptions& options) const;
  void fill_view();
  core::Status settle(StreamHandle stream);
  core::Status launch_search(StreamHandle stream);

  PairsShape shape_;
  LaunchShape settle_shape_;
  LaunchShape grouped_shape_;
  PairsView view_;
  SettleView settle_;
  Start start_ = Start::kNone;
  std::uint32_t count_ = 0;
  std::uint32_t lanes_per_box_ = 1;
  bool is_grouped_ = false;
  bool has_too_many_group_pairs_ = false;
  Mapped<Outcome, 1> outcome_;
  BroadBuffers broad_;
  GroupBuffers groups_;
  DeviceBuffer<PackedBox> boxes_;
  DeviceBuffer<PackedBox> given_;
  DeviceBuffer<core::Pair> pairs_;
  DeviceBuffer<core::Pair> settled_;
  DeviceBuffer<Counters> counters_;
  DeviceBuffer<unsigned long long> barrier_;
};

}  // namespace broadside::gpu
