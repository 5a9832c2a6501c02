// The arbiter of continuous queries as an engine: it gives the lower ends of its brackets, before which there is no
// touch.
#include <memory>
#include <vector>

#include "core/exact/feature_touch.hpp"
#include "core/exact/rigid_touch.hpp"
#include "reference/motion/motion_engines.hpp"

namespace broadside::reference {
namespace {

class Features final : public core::FeatureMotionQuery {
 public:
  core::Result<core::FirstTouch> first_touch(const continuous::MovingFeatures& features) override {
    const exact::TouchTime found = exact::first_touch(features);
    return core::FirstTouch{found.touches, found.lower};
  }
};

class Bodies final : public core::BodyMotionQuery {
 public:
  core::Status load(std::span<const std::shared_ptr<const core::Mesh>> meshes) override {
    shapes_.clear();
    for (const auto& mesh : meshes) shapes_.emplace_back(*mesh, true);
    return core::Done{};
  }

  [[nodiscard]] bool follows(const exact::RigidMotion&) const override { return true; }

  core::Result<core::FirstTouch> first_touch(const core::MovingBody& a, const core::MovingBody& b) override {
    const exact::RigidTouch found = exact::first_touch(shapes_[a.mesh], a.motion, shapes_[b.mesh], b.motion);
    return core::FirstTouch{found.meeting != exact::Meeting::kApart, found.lower};
  }

 private:
  std::vector<exact::MovingShape> shapes_;
};

core::Result<core::MotionEngine> create(const core::Settings& settings) {
  core::MotionEngine engine;
  engine.id = "exact-motion";
  engine.build = "own, integers (GMP) for features, double with certified rounding for bodies";
  engine.settings = settings;
  engine.features = std::make_unique<Features>();
  engine.bodies = std::make_unique<Bodies>();
  return engine;
}

}  // namespace

core::MotionEngineRow exact_motion_row() {
  return {"exact-motion",
          "first touch of features, exact, and of bodies, certified: the arbiter of continuous queries",
          {},
          create,
          true};
}

}  // namespace broadside::reference
