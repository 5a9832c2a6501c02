#include "gpu/rigid/rigid_read_back.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

#include "core/method/rigid/told_point.hpp"
#include "gpu/rigid/rigid_kernel.hpp"

namespace broadside::gpu {

using core::Vec3;

core::Result<std::uint64_t> rigid_digest_of(const RigidLeft& left, const LaunchShape& shape, StreamHandle stream) {
  DeviceBuffer<unsigned long long> sum;
  BROADSIDE_TRY(sum.reserve(1, "digest"));
  BROADSIDE_TRY(sum.fill_bytes(0));
  DeviceBuffer<core::RigidMass> mass;
  BROADSIDE_TRY(mass.upload(left.bodies.mass, "digest"));
  DeviceBuffer<Vec3> spin;
  BROADSIDE_TRY(spin.upload(left.bodies.static_spin, "digest"));
  BROADSIDE_TRY(wait_for_device("the digest"));
  RigidDigestView view;
  view.body_count = static_cast<std::uint32_t>(left.bodies.state.size());
  view.confirmed_count = left.counts.confirmed;
  view.patch_count = left.counts.patches;
  view.detected = left.detected.data();
  view.state = left.state.data();
  view.mass = mass.data();
  view.static_spin = spin.data();
  view.confirmed = left.confirmed.data();
  view.patches = left.patches.data();
  view.impulses = left.impulses.data();
  view.digest = sum.data();
  BROADSIDE_TRY(launch_rigid_digest(view, shape, stream));
  BROADSIDE_TRY(wait_for_stream(stream, "the digest"));
  std::vector<unsigned long long> digest;
  BROADSIDE_TRY(sum.download(digest, 1));
  return std::uint64_t{digest[0]};
}

namespace {

void add_body(const core::RigidBodies& bodies, std::uint32_t i, const core::RigidState& now,
              const core::RigidState& detected, core::FrameRecord& frame) {
  const core::RigidMass& mass = bodies.mass[i];
  frame.position.push_back(core::mesh_origin(mass, now));
  frame.orientation.push_back(now.q);
  frame.velocity.push_back(now.v);
  frame.angular_velocity.push_back(bodies.is_static[i] != 0 ? bodies.static_spin[i]
                                                            : core::angular_velocity(mass, now));
  frame.detected_position.push_back(core::mesh_origin(mass, detected));
  frame.detected_velocity.push_back(detected.v);
  frame.detected_orientation.push_back(detected.q);
}

core::Status add_points(const RigidLeft& left, const std::vector<core::RigidState>& detected,
                        core::FrameRecord& frame) {
  std::vector<core::ContactPatch> patches;
  std::vector<Vec3> impulses;
  BROADSIDE_TRY(left.patches.download(patches, left.counts.patches));
  BROADSIDE_TRY(left.impulses.download(impulses, 4 * left.counts.patches));
  // Patches of one pair lie one after the other, in their order.
  std::vector<std::uint32_t> order(patches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return std::tie(patches[p].a, patches[p].b, p) < std::tie(patches[q].a, patches[q].b, q);
  });
  for (const std::uint32_t k : order) {
    const core::ContactPatch& patch = patches[k];
    for (int point = 0; point < patch.manifold.count; ++point) {
      core::ContactPoint told;
      const Vec3 impulse = impulses[4 * std::size_t{k} + static_cast<std::size_t>(point)];
      if (core::told_point(patch, point, impulse, detected[patch.a].x, told)) frame.points.push_back(told);
    }
  }
  return core::Done{};
}

}  // namespace

core::Status read_back_rigid(const RigidLeft& left, core::FrameRecord& frame) {
  const auto n = static_cast<std::uint32_t>(left.bodies.state.size());
  std::vector<core::RigidState> now;
  std::vector<core::RigidState> detected;
  std::vector<PackedBox> boxes;
  BROADSIDE_TRY(left.state.download(now, n));
  BROADSIDE_TRY(left.detected.download(detected, n));
  BROADSIDE_TRY(left.boxes.download(boxes, n));
  for (std::uint32_t i = 0; i < n; ++i) {
    add_body(left.bodies, i, now[i], detected[i], frame);
    frame.boxes.push_back(unpack(boxes[i]));
  }
  BROADSIDE_TRY(left.pairs.download(frame.pairs, left.pair_count));
  std::sort(frame.pairs.begin(), frame.pairs.end());
  frame.pairs_demanded = frame.pairs_raw = frame.pairs.size();
  BROADSIDE_TRY(left.confirmed.download(frame.confirmed, left.counts.confirmed));
  std::sort(frame.confirmed.begin(), frame.confirmed.end());
  return add_points(left, detected, frame);
}

}  // namespace broadside::gpu
