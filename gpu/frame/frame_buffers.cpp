#include "gpu/frame/frame_buffers.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "gpu/frame/frame_kernel.hpp"

namespace broadside::gpu {
namespace {

// Room at the start. A packed pile of boxes has some six pairs a body, and a body in a corner touches three faces. Too
// little room costs one repeated frame.
constexpr std::uint64_t kFramePairsPerBody = 4;

std::uint64_t with_slack(std::uint64_t demanded) {
  return demanded + demanded / 4;
}

}  // namespace

core::Status DeviceState::reserve(std::size_t bodies) {
  BROADSIDE_TRY(position.reserve(bodies, "positions"));
  return velocity.reserve(bodies, "velocities");
}

core::Status FrameBuffers::load(const core::Scene& scene) {
  const std::size_t n = scene.bodies.size();
  body_count_ = scene.body_count();
  std::vector<PackedVec3> position;
  std::vector<PackedVec3> velocity;
  for (const core::Body& body : scene.bodies) {
    position.push_back({body.position, body.inverse_mass});
    velocity.push_back({body.velocity, 0.0F});
  }
  BROADSIDE_TRY(previous_.position.upload(position, "positions"));
  BROADSIDE_TRY(previous_.velocity.upload(velocity, "velocities"));
  BROADSIDE_TRY(detected_.reserve(n));
  BROADSIDE_TRY(next_.reserve(n));
  BROADSIDE_TRY(boxes_.reserve(n, "boxes"));
  BROADSIDE_TRY(degree_.reserve(n, "order of contacts"));
  BROADSIDE_TRY(list_begin_.reserve(n, "order of contacts"));
  BROADSIDE_TRY(live_.reserve(n, "order of contacts"));
  BROADSIDE_TRY(counters_.reserve(1, "counters"));
  BROADSIDE_TRY(counters_.fill_bytes(0));
  BROADSIDE_TRY(barrier_.reserve(2, "barrier"));
  BROADSIDE_TRY(barrier_.fill_bytes(0));
  const std::uint64_t pairs = std::max(kLeastPairs, kFramePairsPerBody * n);
  BROADSIDE_TRY(pairs_.reserve(pairs, "candidate pairs"));
  BROADSIDE_TRY(face_contacts_.reserve(std::max<std::uint64_t>(kLeastPairs, n), "contacts with faces"));
  return reserve_confirmed(std::max(kLeastPairs, pairs / 2));
}

core::Status FrameBuffers::reserve_confirmed(std::uint64_t count) {
  BROADSIDE_TRY(confirmed_.reserve(count, "confirmed pairs"));
  BROADSIDE_TRY(proximity_.reserve(count, "nearest vertices"));
  if (body_count_ <= kMostSmallBodies) {
    BROADSIDE_TRY(measured_.reserve(count, "nearest vertices"));
    BROADSIDE_TRY(placed_.reserve(count, "nearest vertices"));
  }
  BROADSIDE_TRY(links_.reserve(count, "touching pairs"));
  BROADSIDE_TRY(keys_.reserve(2 * count, "order of contacts"));
  BROADSIDE_TRY(lists_.reserve(2 * count, "order of contacts"));
  return contacts_.reserve(count, "contacts");
}

core::Status FrameBuffers::reserve_leftovers() {
  if (body_count_ > kMostSmallBodies) return core::Done{};
  BROADSIDE_TRY(leftovers_.reserve(2 * std::size_t{LeftoverView::kMost}, "shared searches"));
  BROADSIDE_TRY(
      leftover_entries_.reserve(2 * std::size_t{LeftoverView::kMost} * LeftoverView::kEntries, "shared searches"));
  // Kernels read entries before they know how many there are, so the memory must be initialized.
  return leftover_entries_.fill_bytes(0);
}

core::Status FrameBuffers::grow(const Counters& demanded, bool is_confirmed_by_level0) {
  if (demanded.pairs > pairs_.capacity()) BROADSIDE_TRY(pairs_.reserve(with_slack(demanded.pairs), "candidate pairs"));
  const std::uint64_t confirmed = is_confirmed_by_level0 ? demanded.pairs : demanded.confirmed;
  if (confirmed > confirmed_.capacity()) BROADSIDE_TRY(reserve_confirmed(with_slack(confirmed)));
  if (demanded.faces > face_contacts_.capacity())
    BROADSIDE_TRY(face_contacts_.reserve(with_slack(demanded.faces), "contacts with faces"));
  return wait_for_device("making room");
}

void FrameBuffers::fill(FrameView& view, std::uint64_t under_way) const {
  view.body_count = body_count_;
  view.previous = previous_.view();
  view.detected = detected_.view();
  view.next = next_.view();
  if (under_way % 2 != 0) std::swap(view.previous, view.next);
  view.boxes = boxes_.data();
  view.pairs = {pairs_.data(), pairs_.capacity()};
  view.confirmed = {confirmed_.data(), confirmed_.capacity()};
  view.proximity = proximity_.data();
  view.links = links_.data();
  view.keys = keys_.data();
  view.lists = lists_.data();
  view.contacts = contacts_.data();
  view.face_contacts = {face_contacts_.data(), face_contacts_.capacity()};
  view.degree = degree_.data();
  view.list_begin = list_begin_.data();
  view.counters = counters_.data();
  view.barrier = barrier_.data();
}

void FrameBuffers::fill_small(SmallFrameView& view) const {
  view.measured = measured_.data();
  view.placed = placed_.data();
  view.given_out = barrier_.data() + 1;
  view.leftovers[0] = {leftovers_.data(), leftover_entries_.data()};
  view.leftovers[1] = {leftovers_.data() + LeftoverView::kMost,
                       leftover_entries_.data() + std::size_t{LeftoverView::kMost} * LeftoverView::kEntries};
}

void FrameBuffers::fill_grid(GridFrameView& view) const {
  view.live = live_.data();
}

std::uint64_t FrameBuffers::body_bytes() const {
  return 6 * previous_.position.bytes() + boxes_.bytes() + 2 * degree_.bytes() + live_.bytes() + leftovers_.bytes() +
         leftover_entries_.bytes();
}

std::uint64_t FrameBuffers::appended_bytes() const {
  return pairs_.bytes() + confirmed_.bytes() + proximity_.bytes() + measured_.bytes() + placed_.bytes() +
         links_.bytes() + keys_.bytes() + lists_.bytes() + contacts_.bytes() + face_contacts_.bytes();
}

}  // namespace broadside::gpu
