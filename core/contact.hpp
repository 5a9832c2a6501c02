// One application of the collision response to one pair of bodies, or to one body and one face of the domain.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// Faces of the domain take the place of body B: kFirstFace + 0..5 for -x +x -y +y -z +z. No scene has that many bodies.
constexpr std::uint32_t kFirstFace = 0xFFFFFFF0U;
constexpr int kFaceCount = 6;
// Contacts with faces come after all colors of body contacts.
constexpr std::uint32_t kFaceColor = 0xFFFFFFFFU;

BROADSIDE_HD constexpr bool is_face(std::uint32_t body) {
  return body >= kFirstFace;
}

// Position (m) and velocity (m/s) of one body at one moment.
struct Kinematics {
  Vec3 x;
  Vec3 v;

  friend constexpr bool operator==(const Kinematics&, const Kinematics&) = default;
};

// Normal: unit, from B to A. Depth > 0 is penetration along it, before this application. The normal impulse acts on A
// along +normal (>= 0). The tangent impulse acts on A along +tangent. The tangent is the direction in which A slides
// relative to B after the normal impulse was chosen and before friction (zero when nothing slides), so correct friction
// has a tangent impulse <= 0.
struct Contact {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::uint32_t color = 0;
  float depth_m = 0.0F;
  Vec3 normal;
  float normal_impulse_n_s = 0.0F;
  Vec3 tangent;
  float tangent_impulse_n_s = 0.0F;
  Kinematics pre_a;
  Kinematics pre_b;
  Kinematics post_a;
  Kinematics post_b;
};

static_assert(sizeof(Contact) == 144, "kernel parameter: host and device must agree on its layout");

}  // namespace broadside::core
