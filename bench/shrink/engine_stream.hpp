// An engine's frames, one after another, without a file: a trial of the shrinker judges them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "core/engine/engine.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "validation/judge.hpp"

namespace broadside::bench {

// Puts the recorded states at the end of a frame in place of where the bodies start.
void set_states(std::vector<core::Body>& bodies, const core::FrameRecord& frame);

// Runs the engine in this process. One that does not simulate is fed by octree-cpu with its default settings, frame by
// frame, as recording does it.
class EngineStream {
 public:
  // scene outlives the stream; all of its frames are run. Errors: settings, an engine that is not on this machine or
  // refuses the scene.
  static core::Result<std::unique_ptr<EngineStream>> start(const core::Scene& scene, const CellSpec& spec);

  [[nodiscard]] const core::TraceHeader& header() const { return header_; }
  // For the judge, which reads in order.
  [[nodiscard]] validation::FrameSource source();
  // The bodies as the last frame that was read left them.
  [[nodiscard]] const std::vector<core::Body>& bodies() const { return bodies_; }

 private:
  explicit EngineStream(const core::Scene& scene) : scene_(scene), bodies_(scene.bodies) {}
  core::Status load();
  core::Result<core::FrameRecord> next();
  core::Status find_pairs(core::FrameRecord& frame);
  core::Status measure(core::FrameRecord& frame);

  const core::Scene& scene_;
  core::Engine engine_;
  core::TraceHeader header_;
  std::vector<std::uint64_t> steps_;
  std::vector<core::Body> bodies_;
  std::unique_ptr<EngineStream> driver_;
  bool is_loaded_ = false;
};

}  // namespace broadside::bench
