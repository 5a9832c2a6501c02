#include "bench/cell/step_suffix.hpp"

#include <charconv>
#include <cmath>
#include <string>

namespace broadside::bench {
namespace {

// A run cannot keep more frames than this.
constexpr double kMostFrames = 1e9;

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::pair<std::string_view, std::optional<double>> split_step(std::string_view spec) {
  const std::size_t at = spec.rfind('@');
  if (at == std::string_view::npos) return {spec, std::nullopt};
  const std::string_view text = spec.substr(at + 1);
  const std::size_t slash = text.find('/');
  const auto upper = number(text.substr(0, slash));
  const auto lower = slash == std::string_view::npos ? 1.0 : number(text.substr(slash + 1));
  if (!upper || !lower) return {spec, std::nullopt};
  return {spec.substr(0, at), *upper / *lower};
}

core::Result<core::Scene> scene_at_step(core::Scene scene, double dt_s) {
  const std::string where = scene.name;
  if (!(std::isfinite(dt_s) && dt_s > 0.0))
    return core::Error{"the step after @ is not above zero", where, "write for example " + where + "@1/240"};
  const double frames = std::round(static_cast<double>(scene.frames) * static_cast<double>(scene.dt_s) / dt_s);
  if (!(frames < kMostFrames))
    return core::Error{"the step after @ makes more than a billion frames", where, "take a longer step"};
  scene.dt_s = static_cast<float>(dt_s);
  scene.frames = frames < 1.0 ? 1U : static_cast<std::uint32_t>(frames);
  return scene;
}

}  // namespace broadside::bench
