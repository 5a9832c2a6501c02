// Our own first touch of moving features, in double.
#include "core/continuous/feature_impact.hpp"

#include <memory>

#include "reference/motion/motion_engines.hpp"

namespace broadside::reference {
namespace {

class Features final : public core::FeatureMotionQuery {
 public:
  core::Result<core::FirstTouch> first_touch(const continuous::MovingFeatures& features) override {
    const continuous::Impact found = continuous::first_impact(features);
    return core::FirstTouch{found.touches, found.time};
  }
};

core::Result<core::MotionEngine> create(const core::Settings& settings) {
  core::MotionEngine engine;
  engine.id = "feature-impact";
  engine.build = "own, double";
  engine.settings = settings;
  engine.features = std::make_unique<Features>();
  return engine;
}

}  // namespace

core::MotionEngineRow feature_impact_row() {
  return {"feature-impact",
          "our own first touch of features: directions that part them, certified in double",
          {},
          create,
          true};
}

}  // namespace broadside::reference
