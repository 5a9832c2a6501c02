// Our own first touch of moving features, in double.
#include "core/continuous/feature_impact.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "reference/continuous/surface_impacts.hpp"
#include "reference/motion/motion_engines.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

class Features final : public core::FeatureMotionQuery {
 public:
  explicit Features(const ImpactSettings& settings) : settings_(settings) {}

  core::Result<core::FirstTouch> first_touch(const continuous::MovingFeatures& features) override {
    const continuous::Impact found = continuous::first_impact(features);
    return core::FirstTouch{found.touches, found.time};
  }

  core::Status first_touches(std::span<const continuous::MovingFeatures> features,
                             std::span<core::FirstTouch> found) override {
    times_.resize(features.size());
    first_impacts(features, times_, settings_);
    for (std::size_t k = 0; k < features.size(); ++k)
      found[k] = times_[k] <= 1.0 ? core::FirstTouch{true, times_[k]} : core::FirstTouch{};
    return core::Done{};
  }

 private:
  ImpactSettings settings_;
  std::vector<double> times_;
};

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"lanes",
       "widest",
       {"widest", "1", "4", "8"},
       "how many queries are computed side by side; the answers are the same"},
      threads_setting(),
  }};
  return kSettings;
}

Width width_of(const std::string& lanes) {
  if (lanes == "1") return Width::kOne;
  if (lanes == "4") return Width::kFour;
  return lanes == "8" ? Width::kEight : Width::kWidest;
}

core::Result<core::MotionEngine> create(const core::Settings& settings) {
  const ImpactSettings chosen{width_of(settings.text("lanes")), static_cast<unsigned>(settings.number("threads"))};
  core::MotionEngine engine;
  engine.id = "feature-impact";
  engine.build = "own, double, " + std::to_string(lanes_of(chosen.width)) + " side by side";
  engine.settings = settings;
  engine.features = std::make_unique<Features>(chosen);
  return engine;
}

}  // namespace

core::MotionEngineRow feature_impact_row() {
  return {"feature-impact", "our own first touch of features: separating directions and volumes, certified in double",
          setting_rows(), create, true};
}

}  // namespace broadside::reference
