#include "gpu/frame/frame_record.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace broadside::gpu {
namespace {

std::vector<core::Vec3> unpacked(std::span<const PackedVec3> from) {
  std::vector<core::Vec3> to;
  to.reserve(from.size());
  for (const PackedVec3& p : from) to.push_back(p.v);
  return to;
}

std::vector<core::Contact> in_order_of_application(const FrameArrays& arrays) {
  std::vector<core::Contact> contacts(arrays.contacts.begin(), arrays.contacts.end());
  // Depth 0 marks a pair that no longer overlapped when its turn came.
  std::erase_if(contacts, [](const core::Contact& c) { return !(c.depth_m > 0.0F); });
  contacts.insert(contacts.end(), arrays.face_contacts.begin(), arrays.face_contacts.end());
  std::sort(contacts.begin(), contacts.end(), [](const core::Contact& p, const core::Contact& q) {
    return std::tie(p.color, p.a, p.b) < std::tie(q.color, q.a, q.b);
  });
  return contacts;
}

// Sorts confirmed pairs together with their nearest vertices.
void sort_confirmed(core::FrameRecord& frame) {
  std::vector<std::uint32_t> order(frame.confirmed.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto p, auto q) { return frame.confirmed[p] < frame.confirmed[q]; });
  std::vector<core::Pair> pairs;
  std::vector<core::Proximity> proximity;
  for (const std::uint32_t k : order) {
    pairs.push_back(frame.confirmed[k]);
    if (!frame.proximity.empty()) proximity.push_back(frame.proximity[k]);
  }
  frame.confirmed = std::move(pairs);
  frame.proximity = std::move(proximity);
}

}  // namespace

void fill_record(const FrameArrays& arrays, core::FrameRecord& frame) {
  frame.position = unpacked(arrays.position);
  frame.velocity = unpacked(arrays.velocity);
  frame.detected_position = unpacked(arrays.detected_position);
  frame.detected_velocity = unpacked(arrays.detected_velocity);
  frame.boxes.reserve(arrays.boxes.size());
  for (const PackedBox& box : arrays.boxes) frame.boxes.push_back(unpack(box));
  frame.pairs.assign(arrays.pairs.begin(), arrays.pairs.end());
  frame.confirmed.assign(arrays.confirmed.begin(), arrays.confirmed.end());
  frame.proximity.assign(arrays.proximity.begin(), arrays.proximity.end());
  std::sort(frame.pairs.begin(), frame.pairs.end());
  sort_confirmed(frame);
  frame.contacts = in_order_of_application(arrays);
}

}  // namespace broadside::gpu
