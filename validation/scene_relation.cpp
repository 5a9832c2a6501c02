#include "validation/scene_relation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <utility>

#include "core/scene/transformed_scene.hpp"

namespace broadside::validation {
namespace {

using core::Scene;
using core::Vec3;

// The factor by which one scene has scaled the other's first length that is not zero; 0 when there is none.
float factor_of(Vec3 from, Vec3 to) {
  for (int k = 0; k < 3; ++k)
    if (from[k] != 0.0F) return to[k] / from[k];
  return 0.0F;
}

bool is_power_of_two(float factor) {
  int exponent = 0;
  return factor > 0.0F && std::isfinite(factor) && std::frexp(factor, &exponent) == 0.5F;
}

// Bodies are compared bit by bit, -0 and 0 as different: they are the same when a scene was renumbered, and only then.
static_assert(sizeof(core::Body) == sizeof(core::Body::mesh) + 3 * sizeof(core::Vec3) + sizeof(core::Quat) +
                                        sizeof(core::Body::inverse_mass) + sizeof(core::Material),
              "no padding, whose bytes would say nothing");
int compared(const core::Body& a, const core::Body& b) {
  return std::memcmp(&a, &b, sizeof a);  // NOLINT(bugprone-suspicious-memory-comparison): floats by their bits
}

// place of every body, when the two lists hold the same bodies.
std::optional<std::vector<std::uint32_t>> permutation(const Scene& subject, const Scene& baseline) {
  const std::size_t n = subject.bodies.size();
  if (baseline.bodies.size() != n) return std::nullopt;
  const auto sorted = [n](const Scene& scene) {
    std::vector<std::uint32_t> ids(n);
    std::iota(ids.begin(), ids.end(), 0U);
    std::stable_sort(ids.begin(), ids.end(), [&scene](std::uint32_t p, std::uint32_t q) {
      return compared(scene.bodies[p], scene.bodies[q]) < 0;
    });
    return ids;
  };
  const auto from = sorted(subject);
  const auto to = sorted(baseline);
  std::vector<std::uint32_t> place(n);
  for (std::size_t k = 0; k < n; ++k) {
    if (compared(subject.bodies[from[k]], baseline.bodies[to[k]]) != 0) return std::nullopt;
    place[from[k]] = to[k];
  }
  return place;
}

}  // namespace

std::uint32_t SceneRelation::face(std::uint32_t face) const {
  const std::uint32_t k = face - core::kFirstFace;
  const bool swaps = kind == Kind::kMirrored && k / 2 == static_cast<std::uint32_t>(axis);
  return swaps ? core::kFirstFace + (k ^ 1U) : face;
}

Vec3 SceneRelation::direction(Vec3 v) const {
  if (kind == Kind::kMirrored) v[axis] = -v[axis];
  return v;
}

Vec3 SceneRelation::vector(Vec3 v) const {
  return kind == Kind::kScaled ? factor * v : direction(v);
}

core::Box SceneRelation::box(const core::Box& b) const {
  core::Box out{vector(b.min), vector(b.max)};
  if (kind == Kind::kMirrored) std::swap(out.min[axis], out.max[axis]);
  return out;
}

std::string SceneRelation::text() const {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  char number[32];
  std::snprintf(number, sizeof number, "%g", static_cast<double>(factor));
  switch (kind) {
    case Kind::kScaled:
      return std::string("scaled by ") + number;
    case Kind::kMirrored:
      return std::string("mirrored on ") + kAxes[axis];
    case Kind::kRenumbered:
      return "renumbered";
    case Kind::kGrown:
      return std::string("grown by ") + number;
  }
  return "";
}

std::optional<SceneRelation> relation_of(const Scene& subject, const Scene& baseline) {
  if (subject.bodies.size() != baseline.bodies.size() || subject.meshes.size() != baseline.meshes.size() ||
      subject.meshes.empty())
    return std::nullopt;
  const std::uint64_t wanted = core::scene_digest(baseline);
  if (core::scene_digest(subject) == wanted) return std::nullopt;
  const float scale = factor_of(subject.domain.max, baseline.domain.max);
  if (is_power_of_two(scale) && core::scene_digest(core::scaled_scene(subject, scale)) == wanted)
    return SceneRelation{SceneRelation::Kind::kScaled, scale, 0, {}};
  for (int axis = 0; axis < 3; ++axis)
    if (core::scene_digest(core::mirrored_scene(subject, axis)) == wanted)
      return SceneRelation{SceneRelation::Kind::kMirrored, 1.0F, axis, {}};
  if (const auto place = permutation(subject, baseline)) {
    std::vector<std::uint32_t> order(place->size());
    for (std::uint32_t i = 0; i < place->size(); ++i) order[(*place)[i]] = i;
    if (core::scene_digest(core::renumbered_scene(subject, order)) == wanted)
      return SceneRelation{SceneRelation::Kind::kRenumbered, 1.0F, 0, *place};
  }
  const float growth = factor_of(core::bounds(*subject.meshes[0]).max, core::bounds(*baseline.meshes[0]).max);
  if (growth >= 1.0F && std::isfinite(growth) && core::scene_digest(core::grown_scene(subject, growth)) == wanted)
    return SceneRelation{SceneRelation::Kind::kGrown, growth, 0, {}};
  return std::nullopt;
}

}  // namespace broadside::validation
