#include "gpu/frame_buffers.hpp"

#include <algorithm>
#include <bit>

namespace broadside::gpu {
namespace {

// Room at the start: a packed pile of boxes has some six pairs a body, a body in a corner three faces; what is wrong
// with it costs one repeated frame.
constexpr std::uint64_t kPairsPerBody = 4;
constexpr std::uint64_t kLeastPairs = 1024;
// Buckets of the grid per body: cells that hold a body's box are met by some 27 lookups, most of empty cells.
constexpr std::uint64_t kBucketsPerBody = 2;

std::uint64_t with_slack(std::uint64_t demanded) {
  return demanded + demanded / 4;
}

}  // namespace

core::Status DeviceState::reserve(std::size_t bodies) {
  BROADSIDE_TRY(position.reserve(bodies, "positions"));
  return velocity.reserve(bodies, "velocities");
}

core::Status FrameBuffers::load(const core::Scene& scene, bool has_grid, bool is_jacobi) {
  const std::size_t n = scene.bodies.size();
  body_count_ = scene.body_count();
  color_words_ = 1;
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
  if (has_grid) {
    const std::uint64_t buckets = std::bit_ceil(std::max<std::uint64_t>(kBucketsPerBody * n, 1024));
    BROADSIDE_TRY(bucket_count_.reserve(buckets, "grid"));
    BROADSIDE_TRY(bucket_begin_.reserve(buckets, "grid"));
    BROADSIDE_TRY(rank_.reserve(n, "grid"));
    BROADSIDE_TRY(entries_.reserve(n, "grid"));
    BROADSIDE_TRY(levels_.reserve(1, "grid"));
    BROADSIDE_TRY(bucket_count_.fill_bytes(0));
    BROADSIDE_TRY(levels_.fill_bytes(0));
  }
  BROADSIDE_TRY(degree_.reserve(n, "coloring"));
  BROADSIDE_TRY(list_begin_.reserve(n, "coloring"));
  BROADSIDE_TRY(listed_.reserve(n, "coloring"));
  BROADSIDE_TRY(front_.reserve(2 * n, "coloring"));
  BROADSIDE_TRY(unpublished_.reserve(n, "coloring"));
  BROADSIDE_TRY(reserve_colors());
  if (is_jacobi) BROADSIDE_TRY(sums_.reserve(n, "sums of the Jacobi solver"));
  if (is_jacobi) BROADSIDE_TRY(least_key_.reserve(n, "sums of the Jacobi solver"));
  BROADSIDE_TRY(counters_.reserve(1, "counters"));
  BROADSIDE_TRY(counters_.fill_bytes(0));
  const std::uint64_t pairs = std::max(kLeastPairs, kPairsPerBody * n);
  BROADSIDE_TRY(pairs_.reserve(pairs, "candidate pairs"));
  BROADSIDE_TRY(face_contacts_.reserve(std::max<std::uint64_t>(kLeastPairs, n), "contacts with faces"));
  return reserve_confirmed(std::max(kLeastPairs, pairs / 2));
}

core::Status FrameBuffers::reserve_confirmed(std::uint64_t count) {
  BROADSIDE_TRY(confirmed_.reserve(count, "confirmed pairs"));
  BROADSIDE_TRY(proximity_.reserve(count, "nearest vertices"));
  BROADSIDE_TRY(touching_.reserve(count, "touching pairs"));
  BROADSIDE_TRY(color_.reserve(count, "coloring"));
  BROADSIDE_TRY(color_rank_.reserve(count, "coloring"));
  BROADSIDE_TRY(by_color_.reserve(count, "coloring"));
  BROADSIDE_TRY(list_slots_.reserve(2 * count, "coloring"));
  BROADSIDE_TRY(lists_.reserve(2 * count, "coloring"));
  return contacts_.reserve(count, "contacts");
}

core::Status FrameBuffers::reserve_colors() {
  BROADSIDE_TRY(taken_.reserve(2ULL * body_count_ * color_words_, "coloring"));
  BROADSIDE_TRY(color_count_.reserve(64ULL * color_words_, "coloring"));
  return color_begin_.reserve(64ULL * color_words_ + 1, "coloring");
}

core::Status FrameBuffers::grow(const Counters& demanded, bool is_confirmed_by_level0) {
  if (demanded.pairs > pairs_.capacity()) BROADSIDE_TRY(pairs_.reserve(with_slack(demanded.pairs), "candidate pairs"));
  const std::uint64_t confirmed = is_confirmed_by_level0 ? demanded.pairs : demanded.confirmed;
  if (confirmed > confirmed_.capacity()) BROADSIDE_TRY(reserve_confirmed(with_slack(confirmed)));
  if (demanded.faces > face_contacts_.capacity())
    BROADSIDE_TRY(face_contacts_.reserve(with_slack(demanded.faces), "contacts with faces"));
  if (demanded.words_demanded != 0) {
    color_words_ *= 2;
    BROADSIDE_TRY(reserve_colors());
  }
  return core::Done{};
}

void FrameBuffers::fill(FrameView& view) const {
  view.body_count = body_count_;
  view.previous = previous_.view();
  view.detected = detected_.view();
  view.next = next_.view();
  view.boxes = boxes_.data();
  view.grid.bucket_mask = static_cast<std::uint32_t>(bucket_count_.capacity()) - 1;
  view.grid.bucket_count = bucket_count_.data();
  view.grid.bucket_begin = bucket_begin_.data();
  view.grid.rank = rank_.data();
  view.grid.entries = entries_.data();
  view.grid.levels = levels_.data();
  view.pairs = {pairs_.data(), pairs_.capacity()};
  view.confirmed = {confirmed_.data(), confirmed_.capacity()};
  view.proximity = proximity_.data();
  view.touching = touching_.data();
  view.color = color_.data();
  view.color_rank = color_rank_.data();
  view.by_color = by_color_.data();
  view.list_slots = list_slots_.data();
  view.lists = lists_.data();
  view.color_count = color_count_.data();
  view.color_begin = color_begin_.data();
  view.contacts = contacts_.data();
  view.face_contacts = {face_contacts_.data(), face_contacts_.capacity()};
  view.degree = degree_.data();
  view.list_begin = list_begin_.data();
  view.listed = listed_.data();
  view.front = front_.data();
  view.unpublished = unpublished_.data();
  view.least_key = least_key_.data();
  view.taken = taken_.data();
  view.color_words = color_words_;
  view.sums = sums_.data();
  view.counters = counters_.data();
}

std::uint64_t FrameBuffers::body_bytes() const {
  return 6 * previous_.position.bytes() + boxes_.bytes() + bucket_count_.bytes() + bucket_begin_.bytes() +
         rank_.bytes() + entries_.bytes() + 6 * degree_.bytes() + least_key_.bytes() + taken_.bytes() + sums_.bytes();
}

std::uint64_t FrameBuffers::appended_bytes() const {
  return pairs_.bytes() + confirmed_.bytes() + proximity_.bytes() + touching_.bytes() + 7 * color_.bytes() +
         contacts_.bytes() + face_contacts_.bytes();
}

}  // namespace broadside::gpu
