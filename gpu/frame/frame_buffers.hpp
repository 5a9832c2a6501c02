// Device memory of what changes from frame to frame: states, and buffers that grow when a frame demands more. Those of
// the broad phase are in broad_buffers.hpp.
#pragma once

#include <cstdint>

#include "core/contact.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/scene/scene.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/grid_frame_view.hpp"
#include "gpu/frame/small_frame_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

struct DeviceState {
  DeviceBuffer<PackedVec3> position;
  DeviceBuffer<PackedVec3> velocity;

  core::Status reserve(std::size_t bodies);
  [[nodiscard]] StateView view() const { return {position.data(), velocity.data()}; }
};

class FrameBuffers {
 public:
  // The initial state becomes the previous one. At first there is room for a few pairs and contacts a body.
  core::Status load(const core::Scene& scene);
  // Reserves the memory through which small frames leave the rest of long searches to the whole grid.
  core::Status reserve_leftovers();
  // Fills the view for a frame that comes after `under_way` launched frames for which advance() was not called yet.
  void fill(FrameView& view, std::uint64_t under_way = 0) const;
  // Fills what a small frame, or a grid frame, has in addition.
  void fill_small(SmallFrameView& view) const;
  void fill_grid(GridFrameView& view) const;
  // Makes room for what the aborted frame demanded, and a quarter more. Contents are lost.
  core::Status grow(const Counters& demanded, bool is_confirmed_by_level0);
  // The frame is done: the next one starts from what it made.
  void advance() { std::swap(previous_, next_); }

  // The state at the end of the last frame for which advance() was called; before any step, the initial state.
  [[nodiscard]] const DeviceState& state() const { return previous_; }
  [[nodiscard]] const DeviceState& detected() const { return detected_; }
  [[nodiscard]] const DeviceBuffer<PackedBox>& boxes() const { return boxes_; }
  [[nodiscard]] const DeviceBuffer<core::Pair>& pairs() const { return pairs_; }
  [[nodiscard]] const DeviceBuffer<core::Pair>& confirmed() const { return confirmed_; }
  [[nodiscard]] const DeviceBuffer<core::Proximity>& proximity() const { return proximity_; }
  [[nodiscard]] const DeviceBuffer<core::Contact>& contacts() const { return contacts_; }
  [[nodiscard]] const DeviceBuffer<core::Contact>& face_contacts() const { return face_contacts_; }
  [[nodiscard]] std::uint64_t body_bytes() const;
  [[nodiscard]] std::uint64_t appended_bytes() const;

 private:
  core::Status reserve_confirmed(std::uint64_t count);

  std::uint32_t body_count_ = 0;
  DeviceState previous_;
  DeviceState detected_;
  DeviceState next_;
  DeviceBuffer<PackedBox> boxes_;
  DeviceBuffer<std::uint32_t> degree_;
  DeviceBuffer<std::uint32_t> list_begin_;
  DeviceBuffer<LiveBody> live_;
  DeviceBuffer<Counters> counters_;
  DeviceBuffer<unsigned long long> barrier_;

  DeviceBuffer<core::Pair> pairs_;
  DeviceBuffer<core::Pair> confirmed_;
  DeviceBuffer<core::Proximity> proximity_;
  DeviceBuffer<MeasuredPair> measured_;
  DeviceBuffer<PlacedPair> placed_;
  DeviceBuffer<LeftoverSearch> leftovers_;
  DeviceBuffer<NodePair> leftover_entries_;
  DeviceBuffer<Link> links_;
  DeviceBuffer<unsigned long long> keys_;
  DeviceBuffer<ListEntry> lists_;
  DeviceBuffer<core::Contact> contacts_;
  DeviceBuffer<core::Contact> face_contacts_;
};

}  // namespace broadside::gpu
