// An engine's frames, one after another, without a file, so that the shrinker can judge a trial without writing a
// trace.
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

// Starts the bodies from the recorded states at the end of a frame.
void set_states(std::vector<core::Body>& bodies, const core::FrameRecord& frame);

// Runs the engine in this process. An engine that does not simulate gets the frames of octree-cpu with its default
// settings, as in recording.
class EngineStream {
 public:
  // The scene must outlive the stream; all of its frames are run. Errors: settings, an engine that is not on this
  // machine or refuses the scene.
  static core::Result<std::unique_ptr<EngineStream>> start(const core::Scene& scene, const CellSpec& spec);

  [[nodiscard]] const core::TraceHeader& header() const { return header_; }
  // The frames in order, for the judge.
  [[nodiscard]] validation::FrameSource source();
  // The states of the bodies after the last frame that was read.
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
