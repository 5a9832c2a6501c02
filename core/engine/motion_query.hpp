// Continuous collision queries: given how things move during one step, when do they first touch? And how tables list
// the engines that answer them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/continuous/moving_features.hpp"
#include "core/engine/settings.hpp"
#include "core/exact/rigid_motion.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// time: in units of the step, 0 to 1; 1 where there is no touch.
struct FirstTouch {
  bool touches = false;
  double time = 1.0;
};

class FeatureMotionQuery {
 public:
  virtual ~FeatureMotionQuery() = default;
  virtual Result<FirstTouch> first_touch(const continuous::MovingFeatures& features) = 0;
  // Many queries at once; `found` has one entry per query. An engine's own way to answer many queries faster belongs
  // here.
  virtual Status first_touches(std::span<const continuous::MovingFeatures> features, std::span<FirstTouch> found) {
    for (std::size_t k = 0; k < features.size(); ++k) {
      auto one = first_touch(features[k]);
      if (!one) return one.error();
      found[k] = one.value();
    }
    return Done{};
  }
};

struct MovingBody {
  std::uint32_t mesh = 0;  // index into the meshes that were loaded
  exact::RigidMotion motion;
};

class BodyMotionQuery {
 public:
  virtual ~BodyMotionQuery() = default;
  // Not timed.
  virtual Status load(std::span<const std::shared_ptr<const Mesh>> meshes) = 0;
  // Whether it moves bodies along exactly this path. Many engines use another path for bodies that turn, or ignore
  // turning.
  [[nodiscard]] virtual bool follows(const exact::RigidMotion& motion) const = 0;
  virtual Result<FirstTouch> first_touch(const MovingBody& a, const MovingBody& b) = 0;
};

struct MotionEngine {
  std::string id;
  std::string build;
  Settings settings;
  std::unique_ptr<FeatureMotionQuery> features;  // null = not offered
  std::unique_ptr<BodyMotionQuery> bodies;       // null = not offered
};

struct MotionEngineRow {
  std::string_view id;
  std::string_view what;
  std::span<const SettingRow> settings;
  Result<MotionEngine> (*create)(const Settings& settings) = nullptr;
  // It claims to miss no touch of features and never to report one late; if that claim fails, none of its results
  // count.
  bool is_certified = false;
};

}  // namespace broadside::core
