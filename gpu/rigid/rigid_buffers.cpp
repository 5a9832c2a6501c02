#include "gpu/rigid/rigid_buffers.hpp"

#include <algorithm>

#include "gpu/stages/rigid/constraint_layout.hpp"

namespace broadside::gpu {
namespace {

// Room at first. A heap has some seven contacts a body, and at most twice as many colors as its busiest body has
// contacts. A frame that has more is repeated with room for all of them.
constexpr std::size_t kConfirmedPerBody = 8;
constexpr std::size_t kPatchesPerBody = 6;
constexpr std::size_t kLeast = 1024;
constexpr std::size_t kFirstColors = 128;
// Room is made for more than is needed, so that a growing pile does not repeat every frame.
constexpr std::size_t with_reserve(std::size_t count) {
  return count + count / 4;
}

}  // namespace

core::Status RigidBuffers::Memory::reserve_bodies(std::size_t bodies) {
  BROADSIDE_TRY(begin.reserve(bodies, "bodies"));
  BROADSIDE_TRY(count.reserve(bodies, "bodies"));
  BROADSIDE_TRY(filled.reserve(bodies, "bodies"));
  return count.fill_bytes(0);
}

core::Status RigidBuffers::Memory::reserve_patches(std::size_t patches, bool has_hulls) {
  BROADSIDE_TRY(entries.reserve(2 * patches, "contacts"));
  BROADSIDE_TRY(feature.reserve(4 * patches, "contacts"));
  if (has_hulls) BROADSIDE_TRY(kept.reserve(patches, "contacts"));
  return impulse.reserve(4 * patches, "contacts");
}

void RigidBuffers::Memory::swap(Memory& other) noexcept {
  begin.swap(other.begin);
  count.swap(other.count);
  filled.swap(other.filled);
  entries.swap(other.entries);
  feature.swap(other.feature);
  impulse.swap(other.impulse);
  kept.swap(other.kept);
}

PatchMemory RigidBuffers::Memory::view() const {
  return {begin.data(), count.data(), filled.data(), entries.data(), feature.data(), impulse.data(), kept.data()};
}

std::uint64_t RigidBuffers::Memory::bytes() const {
  return begin.bytes() + count.bytes() + filled.bytes() + entries.bytes() + feature.bytes() + impulse.bytes() +
         kept.bytes();
}

core::Status RigidBuffers::Sleep::reserve_bodies(std::size_t bodies) {
  BROADSIDE_TRY(asleep.reserve(bodies, "bodies"));
  BROADSIDE_TRY(still.reserve(bodies, "bodies"));
  BROADSIDE_TRY(island.reserve(bodies, "bodies"));
  BROADSIDE_TRY(parent.reserve(bodies, "bodies"));
  return restless.reserve(bodies, "bodies");
}

void RigidBuffers::Sleep::fill(RigidFrameView& view) const {
  view.asleep = asleep.data();
  view.sleep.still = still.data();
  view.sleep.island = island.data();
  view.sleep.parent = parent.data();
  view.sleep.restless = restless.data();
  view.sleep.old = old.data();
  view.sleep.old_count = old_count;
  view.sleep.now = {now.data(), now.capacity()};
}

std::uint64_t RigidBuffers::Sleep::bytes() const {
  return asleep.bytes() + still.bytes() + island.bytes() + parent.bytes() + restless.bytes() + old.bytes() +
         now.bytes();
}

core::Status RigidBuffers::wake_all() {
  if (!may_sleep_) return core::Done{};
  sleep_.old_count = 0;
  BROADSIDE_TRY(sleep_.asleep.fill_bytes(0));
  return sleep_.still.fill_bytes(0);
}

core::Status RigidBuffers::reserve_confirmed(std::size_t pairs) {
  BROADSIDE_TRY(confirmed_.reserve(pairs, "pairs"));
  if (has_hulls_) {
    BROADSIDE_TRY(fresh_.reserve(confirmed_.capacity(), "pairs"));
    BROADSIDE_TRY(hulls_.reserve(confirmed_.capacity(), "pairs"));
    BROADSIDE_TRY(hull_gaps_.reserve(confirmed_.capacity(), "pairs"));
  }
  return near_.reserve(confirmed_.capacity(), "pairs");
}

core::Status RigidBuffers::reserve_patches(std::size_t patches) {
  BROADSIDE_TRY(patches_.reserve(patches, "contacts"));
  BROADSIDE_TRY(ranks_.reserve(patches, "contacts"));
  BROADSIDE_TRY(patch_colors_.reserve(patches, "contacts"));
  BROADSIDE_TRY(impulses_.reserve(4 * patches, "contacts"));
  BROADSIDE_TRY(by_color_.reserve(2 * patches, "contacts"));
  if (may_sleep_) BROADSIDE_TRY(sleep_.now.reserve(patches, "contacts"));
  return memory_.reserve_patches(patches, has_hulls_);
}

core::Status RigidBuffers::reserve_places(std::size_t places) {
  BROADSIDE_TRY(patch_at_.reserve(places, "contacts"));
  BROADSIDE_TRY(changes_.reserve(places, "contacts"));
  return constraints_.reserve(constraint_words(places), "contacts");
}

core::Status RigidBuffers::reserve_colors(std::size_t colors) {
  colors_ = std::max(colors_, colors);
  BROADSIDE_TRY(color_begin_.reserve(colors_ + 1, "colors"));
  BROADSIDE_TRY(color_cursor_.reserve(colors_, "colors"));
  BROADSIDE_TRY(color_count_.reserve(colors_, "colors"));
  return color_count_.fill_bytes(0);
}

core::Status RigidBuffers::load(std::span<const core::RigidState> states, bool may_sleep, bool has_hulls) {
  const std::size_t n = states.size();
  may_sleep_ = may_sleep;
  has_hulls_ = has_hulls;
  if (may_sleep) {
    BROADSIDE_TRY(sleep_.reserve_bodies(n));
    BROADSIDE_TRY(wake_all());
  }
  BROADSIDE_TRY(before_.upload(states, "bodies"));
  BROADSIDE_TRY(after_.upload(states, "bodies"));
  BROADSIDE_TRY(free_end_.reserve(n, "bodies"));
  BROADSIDE_TRY(pushers_.reserve(n, "bodies"));
  BROADSIDE_TRY(old_push_.reserve(n, "bodies"));
  BROADSIDE_TRY(old_push_.fill_bytes(0));
  BROADSIDE_TRY(push_.reserve(n, "bodies"));
  BROADSIDE_TRY(old_passed_on_.reserve(n, "bodies"));
  BROADSIDE_TRY(old_passed_on_.fill_bytes(0));
  BROADSIDE_TRY(passed_on_.reserve(n, "bodies"));
  BROADSIDE_TRY(reach_m_.reserve(n, "bodies"));
  BROADSIDE_TRY(fall_m_.reserve(n, "bodies"));
  BROADSIDE_TRY(pushed_m_.reserve(n, "bodies"));
  BROADSIDE_TRY(shape_boxes_.reserve(n, "bodies"));
  BROADSIDE_TRY(boxes_.reserve(n, "bodies"));
  BROADSIDE_TRY(coloring_.reserve(n, "bodies"));
  BROADSIDE_TRY(bodies_.reserve(n + 1, "bodies"));
  BROADSIDE_TRY(inverse_mass_.reserve(n + 1, "bodies"));
  BROADSIDE_TRY(starts_.reserve(n + 1, "bodies"));
  BROADSIDE_TRY(stirred_.reserve(n + 1, "bodies"));
  BROADSIDE_TRY(relaxed_.reserve(n, "bodies"));
  BROADSIDE_TRY(old_memory_.reserve_bodies(n));
  BROADSIDE_TRY(memory_.reserve_bodies(n));
  BROADSIDE_TRY(reserve_confirmed(std::max(kLeast, kConfirmedPerBody * n)));
  BROADSIDE_TRY(reserve_patches(std::max(kLeast, kPatchesPerBody * n)));
  BROADSIDE_TRY(old_memory_.reserve_patches(std::max(kLeast, kPatchesPerBody * n), has_hulls));
  colors_ = 0;
  BROADSIDE_TRY(reserve_colors(kFirstColors));
  BROADSIDE_TRY(reserve_places(std::max(kLeast, kPatchesPerBody * n) + 32 * kFirstColors));
  BROADSIDE_TRY(counts_.reserve(1, "counters"));
  BROADSIDE_TRY(counts_.fill_bytes(0));
  BROADSIDE_TRY(barrier_.reserve(1, "barrier"));
  return barrier_.fill_bytes(0);
}

// How many patches the arrays of this step have room for. The two memories are swapped after every step, and only the
// memory of the present step grows, so their capacities may differ.
std::size_t RigidBuffers::patch_room() const {
  return std::min({may_sleep_ ? sleep_.now.capacity() : patches_.capacity(), patches_.capacity(), ranks_.capacity(),
                   patch_colors_.capacity(), impulses_.capacity() / 4, by_color_.capacity() / 2,
                   memory_.entries.capacity() / 2, memory_.feature.capacity() / 4, memory_.impulse.capacity() / 4,
                   has_hulls_ ? memory_.kept.capacity() : patches_.capacity()});
}

core::Status RigidBuffers::grow(const RigidCounts& demanded) {
  if (demanded.confirmed > confirmed_.capacity()) BROADSIDE_TRY(reserve_confirmed(with_reserve(demanded.confirmed)));
  if (demanded.patches > patch_room()) BROADSIDE_TRY(reserve_patches(with_reserve(demanded.patches)));
  if (demanded.colors > colors_) BROADSIDE_TRY(reserve_colors(with_reserve(demanded.colors)));
  if (demanded.places > patch_at_.capacity()) BROADSIDE_TRY(reserve_places(with_reserve(demanded.places)));
  return wait_for_device("making room for contacts");
}

void RigidBuffers::advance(const RigidCounts& kept) {
  if (may_sleep_) sleep_.old.swap(sleep_.now);
  sleep_.old_count = kept.asleep_patches;
  before_.swap(after_);
  old_push_.swap(push_);
  old_passed_on_.swap(passed_on_);
  old_memory_.swap(memory_);
}

void RigidBuffers::fill(RigidFrameView& view) const {
  view.before = before_.data();
  view.after = after_.data();
  view.free_end = free_end_.data();
  view.pushers = pushers_.data();
  view.old_push = old_push_.data();
  view.push = push_.data();
  view.old_passed_on = old_passed_on_.data();
  view.passed_on = passed_on_.data();
  view.reach_m = reach_m_.data();
  view.fall_m = fall_m_.data();
  view.pushed_m = pushed_m_.data();
  view.shape_boxes = shape_boxes_.data();
  view.boxes = boxes_.data();
  view.confirmed = {confirmed_.data(), confirmed_.capacity()};
  view.near = near_.data();
  view.fresh = has_hulls_ ? fresh_.data() : nullptr;
  view.hulls = has_hulls_ ? hulls_.data() : nullptr;
  view.hull_gaps = has_hulls_ ? hull_gaps_.data() : nullptr;
  view.patches = {patches_.data(), patch_room()};
  view.ranks = ranks_.data();
  view.colors = patch_colors_.data();
  view.coloring = coloring_.data();
  view.color_capacity = static_cast<std::uint32_t>(colors_);
  view.color_count = color_count_.data();
  view.color_begin = color_begin_.data();
  view.color_cursor = color_cursor_.data();
  view.patch_at = patch_at_.data();
  view.place_capacity = patch_at_.capacity();
  view.constraints.words = constraints_.data();
  view.changes = changes_.data();
  view.by_color = by_color_.data();
  view.bodies = bodies_.data();
  view.inverse_mass = inverse_mass_.data();
  view.starts = starts_.data();
  view.stirred = stirred_.data();
  view.relaxed = relaxed_.data();
  view.impulses = impulses_.data();
  view.old_memory = old_memory_.view();
  view.memory = memory_.view();
  if (may_sleep_) sleep_.fill(view);
  view.counts = counts_.data();
  view.barrier = barrier_.data();
}

std::uint64_t RigidBuffers::bytes() const {
  return before_.bytes() + after_.bytes() + free_end_.bytes() + pushers_.bytes() + old_push_.bytes() + push_.bytes() +
         old_passed_on_.bytes() + passed_on_.bytes() + reach_m_.bytes() + fall_m_.bytes() + pushed_m_.bytes() +
         shape_boxes_.bytes() + boxes_.bytes() + confirmed_.bytes() + near_.bytes() + fresh_.bytes() + hulls_.bytes() +
         hull_gaps_.bytes() + patches_.bytes() + ranks_.bytes() + patch_colors_.bytes() + coloring_.bytes() +
         color_count_.bytes() + color_begin_.bytes() + color_cursor_.bytes() + patch_at_.bytes() +
         constraints_.bytes() + changes_.bytes() + by_color_.bytes() + bodies_.bytes() + inverse_mass_.bytes() +
         starts_.bytes() + stirred_.bytes() + relaxed_.bytes() + impulses_.bytes() + old_memory_.bytes() +
         memory_.bytes() + sleep_.bytes() + counts_.bytes() + barrier_.bytes();
}

}  // namespace broadside::gpu
