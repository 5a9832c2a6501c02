// A whole simulation, step by step.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/engine/counter.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

struct StageTime {
  std::string_view stage;  // static storage
  double seconds = 0.0;
};

class Dynamics {
 public:
  virtual ~Dynamics() = default;

  // Not timed. The scene has passed check_scene and outlives this object.
  virtual Status load(const Scene& scene) = 0;
  // Timed. Advances by dt; a GPU engine's state stays on the device, and the call returns when the work is complete.
  virtual Status step(float dt_s) = 0;
  // Has its own timing zone. Gives the frame that the last step made. kDigest fills digest and counts only.
  virtual Status read_back(FrameRecord& frame, RecordLevel level) = 0;
  // bit(Group) of each group that read_back fills at kFull: known after construction, the same for every frame.
  [[nodiscard]] virtual std::uint32_t groups() const = 0;
  // Times of the last step's stages, in pipeline order; empty when the engine cannot tell its stages apart.
  [[nodiscard]] virtual std::span<const StageTime> stage_times() const { return {}; }
  // Work done since load; empty when the engine does not count.
  [[nodiscard]] virtual std::vector<Counter> counters() const { return {}; }
};

}  // namespace broadside::core
