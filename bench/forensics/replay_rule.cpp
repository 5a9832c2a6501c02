#include "bench/forensics/replay_rule.hpp"

#include <algorithm>
#include <cmath>

#include "validation/rounding.hpp"

namespace broadside::bench {
namespace {

using validation::rounding;

constexpr double kTwoEngines = 2.0;
const double kDiagonal = std::sqrt(3.0);

double largest(core::Vec3 v) {
  return std::max({std::abs(double{v.x}), std::abs(double{v.y}), std::abs(double{v.z})});
}

}  // namespace

bool PairRule::passes(const core::FrameDifference& d) {
  if (d.kind == core::DifferenceKind::kOrder) return true;  // a set has none
  const bool is_extra = d.kind == core::DifferenceKind::kOnlyInA && !is_exact_;
  if (is_extra) ++extra_;
  return is_extra;
}

SeparationRule::SeparationRule(const core::Scene& scene) {
  std::vector<double> of_mesh;
  for (const auto& mesh : scene.meshes) {
    double reach = 0.0;
    // A vertex keeps its distance from the origin when it is turned.
    for (const core::Vec3 v : mesh->vertices)
      reach = std::max(reach, std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z));
    of_mesh.push_back(reach);
  }
  for (const core::Body& body : scene.bodies) reach_m_.push_back(of_mesh[body.mesh]);
}

void SeparationRule::enter(const core::FrameRecord& a, const core::FrameRecord& b) {
  a_ = &a;
  b_ = &b;
  judged_ += a.separations.size();
}

bool SeparationRule::passes(const core::FrameDifference& d) {
  const bool is_distance = d.field == "/trace/narrow/distance";
  if (!is_distance && d.field != "/trace/narrow/touching")
    return d.field.starts_with("/trace/narrow/") && d.field != "/trace/narrow/pairs";
  const core::Separation& p = a_->separations[d.record];
  const core::Separation& q = b_->separations[d.record];
  double far = 0.0;
  for (const std::uint32_t body : d.bodies) far += largest(a_->detected_position[body]) + reach_m_[body];
  const double limit = kTwoEngines * kDiagonal * rounding(1) * far;
  const bool is_overlap = p.distance_m <= limit || q.distance_m <= limit;
  if (!is_distance) return std::min(std::abs(p.distance_m), std::abs(q.distance_m)) <= limit;
  if (is_overlap)
    return std::min(p.distance_m, q.distance_m) <= limit && std::max(p.distance_m, q.distance_m) <= 2.0 * limit;
  return std::abs(p.distance_m - q.distance_m) <= limit;
}

}  // namespace broadside::bench
