// Pairs of bodies in, separations out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

struct Pose {
  Vec3 position;
  Quat orientation;
};

// Separation of two surfaces: distance < 0 is penetration, 0 touching or overlap of unknown depth. Normal: unit, from B
// to A (A = i, B = j); zero when the engine gives none. Witness points in the world frame, m.
struct Separation {
  double distance_m = 0.0;
  bool is_touching = false;
  Vec3 normal;
  Vec3 witness_a;
  Vec3 witness_b;
};

class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;

  // Not timed: builds the structures of each mesh.
  virtual Status load(const Scene& scene) = 0;
  // Timed. poses has one entry per body of the scene.
  virtual Status measure(std::span<const Pair> pairs, std::span<const Pose> poses) = 0;
  // Has its own timing zone. One separation per measured pair, in order.
  virtual Result<std::vector<Separation>> read_back() = 0;
};

}  // namespace broadside::core
