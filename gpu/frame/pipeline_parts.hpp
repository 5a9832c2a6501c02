// The members of a pipeline; only its own sources, pipeline*.cpp, include this.
#pragma once

#include <array>
#include <cstdint>

#include "gpu/broad/broad_buffers.hpp"
#include "gpu/frame/frame_buffers.hpp"
#include "gpu/frame/frame_copy.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/frame/frame_queue.hpp"
#include "gpu/frame/pipeline.hpp"
#include "gpu/runtime/host_side.hpp"
#include "gpu/scene/device_scene.hpp"
#include "gpu/work/work_counter.hpp"

namespace broadside::gpu {

struct Pipeline::Impl {
  PipelineOptions options;
  const core::Scene* scene = nullptr;
  StreamHandle stream = nullptr;  // frame_stream()
  Stream copy_stream;
  Mapped<unsigned long long, 2> digests;  // [0]: of frames whose step is even; [1]: odd
  FrameQueue frames;
  DeviceScene device_scene;
  FrameBuffers buffers;
  BroadBuffers broad;
  StreamMark frame_end;
  LaunchShape launch;
  WorkCounter work;
  FrameView view;  // what is the same in every frame
  BroadView broad_view;
  Counters last;
  std::array<core::StageTime, core::kStageCount> times{};
  std::uint64_t steps = 0;
  std::uint64_t repeats = 0;
  std::uint64_t pairs_tested = 0;
  std::uint64_t all_pairs = 0;  // pairs of bodies in the scene, except two static bodies
  // The last step whose digest was read, and how many steps lie between it and the read before. 0 before the first.
  std::uint64_t asked_step = 0;
  std::uint64_t asked_stride = 0;
  bool has_digest = false;  // the kernel of the last step's digest is in the stream
  // Frames on their way to the host: two, used in turn.
  std::array<FrameCopy, 2> copies;
  std::uint64_t copies_started = 0;
  std::uint64_t copies_finished = 0;
  double dt_s = 0.0;

  [[nodiscard]] bool is_confirmed_by_level0() const {
    return broad_view.start != Start::kNone && view.levels == core::Levels::kFlat;
  }
  [[nodiscard]] std::uint64_t confirmed_count() const { return is_confirmed_by_level0() ? last.pairs : last.confirmed; }
  [[nodiscard]] Start chosen_start() const;
  [[nodiscard]] bool starts_at_level0() const { return chosen_start() != Start::kNone; }
  // Whether the digest of the next frame will probably be asked for: it is if reads keep the distance that they last
  // had.
  [[nodiscard]] bool expects_digest() const { return steps > 0 && steps + 1 == asked_step + asked_stride; }
  [[nodiscard]] LaunchShape frame_shape() const;
  [[nodiscard]] bool levels_come_first(const LaunchShape& shape) const;
  core::Status launch_frame();
  [[nodiscard]] SmallFrameView small_view(const LaunchShape& shape) const;
  [[nodiscard]] GridFrameView grid_view() const;
  core::Status wait_for_frame();
  core::Result<bool> is_kept();
  void take_frame();
  core::Status run_alone();
  core::Status run_ahead(std::uint64_t steps_asked, const StepDone& step_done);
  core::Status settled(core::Status status);
  core::Status count_work();
  core::Status start_digest(const StateView& state, std::uint64_t step);
  void take_digests();
};

}  // namespace broadside::gpu
