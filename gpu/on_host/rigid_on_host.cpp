// The launches of frames of turning bodies on fibers of the host.
#include "gpu/on_host/small_grid.hpp"
#include "gpu/rigid/rigid_kernel.hpp"
#include "gpu/rigid/swept_launch.hpp"
#include "gpu/stages/rigid/constraint_frame.cuh"
#include "gpu/stages/rigid/contact_frame.cuh"
#include "gpu/stages/rigid/place_stage.cuh"
#include "gpu/stages/rigid/rigid_digest.cuh"
#include "gpu/stages/rigid/sleep_stage.cuh"
#include "gpu/stages/rigid/solve_frame.cuh"
#include "gpu/stages/rigid/swept_stage.cuh"

namespace broadside::gpu {
namespace {

using on_host::kBlocks;
using on_host::kThreads;
// Threads of the solver: so few that even in a small heap some colors have more patches than threads.
constexpr std::uint32_t kSolveThreads = 32;

}  // namespace

core::Result<LaunchShape> contact_launch_shape() {
  return LaunchShape{kThreads, kBlocks, 0, kBlocks};
}

core::Result<LaunchShape> near_contact_launch_shape() {
  return contact_launch_shape();
}

core::Result<LaunchShape> long_contact_launch_shape() {
  return contact_launch_shape();
}

core::Result<LaunchShape> constraint_launch_shape() {
  return contact_launch_shape();
}

core::Result<SolveShape> solve_launch_shape() {
  return SolveShape{{kSolveThreads, kBlocks, 0, kBlocks}, kBlocks};
}

core::Status launch_place(const RigidFrameView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_place(frame); });
  return core::Done{};
}

core::Status launch_contacts(const ContactView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_short_contacts(frame); });
  return core::Done{};
}

core::Status launch_near_contacts(const ContactView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_near_contacts(frame); });
  return core::Done{};
}

core::Status launch_long_contacts(const ContactView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_long_contacts(frame); });
  return core::Done{};
}

core::Status launch_constraints(const RigidFrameView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_constraints(frame); });
  return core::Done{};
}

core::Status launch_solve(const RigidFrameView& frame, std::uint32_t blocks, StreamHandle /*stream*/) {
  on_host::run({{blocks}, {kSolveThreads}, on_host::order_seed()}, sizeof(SolveShared), [&](unsigned char* shared) {
    run_solve(frame, frame.constraints, *reinterpret_cast<SolveShared*>(shared));
  });
  return core::Done{};
}

core::Result<LaunchShape> swept_launch_shape() {
  return contact_launch_shape();
}

core::Status launch_ways(const SweptView& view, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_ways(view); });
  return core::Done{};
}

core::Status launch_stop_short(const SweptView& view, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_stop_short(view); });
  return core::Done{};
}

core::Result<LaunchShape> sleep_launch_shape() {
  return contact_launch_shape();
}

core::Status launch_wake(const RigidFrameView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_wake(frame); });
  return core::Done{};
}

core::Status launch_fall_asleep(const RigidFrameView& frame, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_fall_asleep(frame); });
  return core::Done{};
}

core::Status launch_rigid_digest(const RigidDigestView& view, const LaunchShape& /*shape*/, StreamHandle /*stream*/) {
  on_host::run({{kBlocks}, {kThreads}, on_host::order_seed()}, 0, [&](unsigned char*) { run_rigid_digest(view); });
  return core::Done{};
}

}  // namespace broadside::gpu
