#include "gpu/frame_record.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace broadside::gpu {
namespace {

core::Status read_vectors(const DeviceBuffer<PackedVec3>& from, std::uint64_t count, std::vector<core::Vec3>& to) {
  std::vector<PackedVec3> packed;
  BROADSIDE_TRY(from.download(packed, count));
  to.reserve(count);
  for (const PackedVec3& p : packed) to.push_back(p.v);
  return core::Done{};
}

core::Status read_contacts(const FrameBuffers& buffers, const FrameCounts& counts,
                           std::vector<core::Contact>& contacts) {
  BROADSIDE_TRY(buffers.contacts().download(contacts, counts.contacts));
  // Depth 0 marks a pair that did not overlap any more when its turn came.
  std::erase_if(contacts, [](const core::Contact& c) { return !(c.depth_m > 0.0F); });
  std::vector<core::Contact> faces;
  BROADSIDE_TRY(buffers.face_contacts().download(faces, counts.face_contacts));
  contacts.insert(contacts.end(), faces.begin(), faces.end());
  std::sort(contacts.begin(), contacts.end(), [](const core::Contact& p, const core::Contact& q) {
    return std::tie(p.color, p.a, p.b) < std::tie(q.color, q.a, q.b);
  });
  return core::Done{};
}

// Confirmed pairs and their nearest vertices, sorted together.
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

core::Status read_frame(const FrameBuffers& buffers, const FrameCounts& counts, bool is_confirmed_by_level0,
                        core::FrameRecord& frame) {
  BROADSIDE_TRY(read_vectors(buffers.state().position, counts.bodies, frame.position));
  BROADSIDE_TRY(read_vectors(buffers.state().velocity, counts.bodies, frame.velocity));
  BROADSIDE_TRY(read_vectors(buffers.detected().position, counts.bodies, frame.detected_position));
  BROADSIDE_TRY(read_vectors(buffers.detected().velocity, counts.bodies, frame.detected_velocity));
  std::vector<PackedBox> boxes;
  BROADSIDE_TRY(buffers.boxes().download(boxes, counts.bodies));
  for (const PackedBox& box : boxes) frame.boxes.push_back(unpack(box));

  BROADSIDE_TRY(buffers.pairs().download(frame.pairs, counts.pairs));
  BROADSIDE_TRY(
      (is_confirmed_by_level0 ? buffers.pairs() : buffers.confirmed()).download(frame.confirmed, counts.confirmed));
  BROADSIDE_TRY(buffers.proximity().download(frame.proximity, counts.proximity));
  std::sort(frame.pairs.begin(), frame.pairs.end());
  sort_confirmed(frame);
  return read_contacts(buffers, counts, frame.contacts);
}

}  // namespace broadside::gpu
