// The immutable description of a simulation that every engine is given.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "core/scene/mass_properties.hpp"
#include "core/scene/mesh.hpp"
#include "core/scene/spring.hpp"
#include "core/scene/wrench.hpp"

namespace broadside::core {

struct Body {
  std::uint32_t mesh = 0;     // index into Scene::meshes
  Vec3 position;              // of the mesh's origin, m
  Quat orientation;           // world from body; constant during a run where bodies only translate
  Vec3 velocity;              // m/s
  Vec3 angular_velocity;      // rad/s; engines whose bodies only translate require zero
  float inverse_mass = 1.0F;  // 1/kg; 0 = static
  Material material;
};

// Whether the bodies of a scene may turn. METHOD's bodies translate.
enum class Motion : std::uint32_t { kTranslate = 0, kRigid = 1 };

std::string_view motion_word(Motion motion);

struct Scene {
  std::string name;         // "freefall:bunny:50", or the name in the scene file
  std::string description;  // one sentence for reports
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Body> bodies;
  std::vector<Spring> springs;   // most scenes have none
  std::vector<Wrench> wrenches;  // likewise
  Box domain;                    // its faces are static half-spaces
  Material face_material;
  Vec3 gravity_m_s2;
  float dt_s = 1.0F / 60.0F;
  std::uint32_t frames = 1;
  std::uint64_t seed = 0;
  Parameters parameters;
  Motion motion = Motion::kTranslate;
  // One per body where the scene gives them; otherwise empty, and mass_properties_of derives them.
  std::vector<MassProperties> mass_properties;
  // One per body where the scene marks some as fast: 1 = an engine that can do so keeps the body from passing through
  // anything within a step. Otherwise empty.
  std::vector<std::uint8_t> is_fast;
  // The name of the formula for the scene's outcome (validation/mechanics/answers/); empty = none is known.
  std::string answer;

  [[nodiscard]] std::uint32_t body_count() const { return static_cast<std::uint32_t>(bodies.size()); }
};

// Checks all that an engine may rely on: finite numbers, masses and parameters in range, unit quaternions, indices that
// exist, meshes with triangles, a domain with volume. The error names the first violation with its body and field.
Status check_scene(const Scene& scene);

// The mass properties that the scene gives, or those of a body of uniform density. The error for a mesh without inertia
// names the body.
Result<MassProperties> mass_properties_of(const Scene& scene, std::uint32_t body);
// The same for all bodies, with each mesh evaluated once; zero for static bodies.
Result<std::vector<MassProperties>> all_mass_properties(const Scene& scene);
// One line with the reason for each mesh of a moving body whose inertia is that of its convex hull. Empty where the
// scene gives mass properties and where bodies translate.
std::vector<std::string> hull_notes(const Scene& scene);

// XXH64 over the canonical little-endian bytes of everything but name, description and mesh provenance.
std::uint64_t scene_digest(const Scene& scene);

}  // namespace broadside::core
