// How one scene follows from another: which transformation of core/scene/transformed_scene.hpp leads there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/contact.hpp"
#include "core/scene/scene.hpp"

namespace broadside::validation {

struct SceneRelation {
  enum class Kind { kScaled, kMirrored, kRenumbered, kGrown };
  Kind kind = Kind::kScaled;
  float factor = 1.0F;               // scaled, grown
  int axis = 0;                      // mirrored
  std::vector<std::uint32_t> place;  // renumbered: body i of the subject is body place[i] of the baseline

  [[nodiscard]] std::uint32_t body(std::uint32_t i) const {
    return kind == Kind::kRenumbered && i < place.size() ? place[i] : i;
  }
  // The face that stands for this one.
  [[nodiscard]] std::uint32_t face(std::uint32_t face) const;
  // A position or velocity of the subject, as the baseline should have it.
  [[nodiscard]] core::Vec3 vector(core::Vec3 v) const;
  // A direction: mirrored, never scaled.
  [[nodiscard]] core::Vec3 direction(core::Vec3 v) const;
  // A length, speed or impulse.
  [[nodiscard]] float length(float v) const { return kind == Kind::kScaled ? factor * v : v; }
  [[nodiscard]] core::Box box(const core::Box& b) const;
  // "mirrored on x": for sentences.
  [[nodiscard]] std::string text() const;
};

// Nothing for one and the same scene, and when no such transformation of `subject` has the baseline's digest. Bodies
// that are equal in every property cannot be told apart, and count as renumbered in the order in which they stand.
std::optional<SceneRelation> relation_of(const core::Scene& subject, const core::Scene& baseline);

}  // namespace broadside::validation
