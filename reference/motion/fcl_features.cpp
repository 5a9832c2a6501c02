// FCL's vertex-face and edge-edge queries: the parts of its polynomial solver that its mesh traversal calls.
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>

#include <array>
#include <memory>

#include "reference/motion/motion_engines.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using Intersect = fcl::detail::Intersect<double>;
using Vector = fcl::Vector3<double>;

Vector vector(const core::Vec3d& v) {
  return {v.x, v.y, v.z};
}

class Features final : public core::FeatureMotionQuery {
 public:
  Features(bool is_filtered, bool uses_newton) : is_filtered_(is_filtered), uses_newton_(uses_newton) {}

  core::Result<core::FirstTouch> first_touch(const continuous::MovingFeatures& f) override {
    return vendor_call("fcl-features: first touch", [&]() -> core::Result<core::FirstTouch> { return ask(f); });
  }

  // FCL is asked as its own traversal asks it: one query after the other, without other work around them.
  core::Status first_touches(std::span<const continuous::MovingFeatures> features,
                             std::span<core::FirstTouch> found) override {
    return vendor_call("fcl-features: first touches", [&]() -> core::Status {
      for (std::size_t k = 0; k < features.size(); ++k) found[k] = ask(features[k]);
      return core::Done{};
    });
  }

 private:
  [[nodiscard]] core::FirstTouch ask(const continuous::MovingFeatures& f) const {
    std::array<Vector, 4> from, to;
    for (int k = 0; k < 4; ++k) {
      from[k] = vector(f.start[k]);
      to[k] = vector(f.end[k]);
    }
    double time = 1.0;
    Vector at;
    bool touches = false;
    if (f.kind == continuous::FeatureKind::kVertexFace) {
      const auto query = is_filtered_ ? Intersect::intersect_VF_filtered : Intersect::intersect_VF;
      touches = query(from[1], from[2], from[3], from[0], to[1], to[2], to[3], to[0], &time, &at, uses_newton_);
    } else {
      const auto query = is_filtered_ ? Intersect::intersect_EE_filtered : Intersect::intersect_EE;
      touches = query(from[0], from[1], from[2], from[3], to[0], to[1], to[2], to[3], &time, &at, uses_newton_);
    }
    return {touches, touches ? time : 1.0};
  }

  bool is_filtered_;
  bool uses_newton_;
};

std::span<const core::SettingRow> fcl_features_settings() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"filter",
       "none",
       {"none", "plane"},
       "FCL's filtered form tests first whether a fixed plane separates the features"},
      {"root", "newton", {"newton", "cubic"}, "how the coplanar times are found: by Newton's method or in closed form"},
  }};
  return kSettings;
}

core::Result<core::MotionEngine> make_fcl_features(const core::Settings& settings) {
  core::MotionEngine engine;
  engine.id = "fcl-features";
  engine.build = fcl_build();
  engine.settings = settings;
  engine.features = std::make_unique<Features>(settings.text("filter") == "plane", settings.text("root") == "newton");
  return engine;
}

}  // namespace

core::MotionEngineRow fcl_features_row() {
  return {"fcl-features", "FCL's vertex-face and edge-edge queries, as its polynomial solver asks them",
          fcl_features_settings(), make_fcl_features};
}

}  // namespace broadside::reference
