// What the scenes with a known answer (`rigid:*`) are put together from.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace broadside::datasets {

// Standard gravity along -y, over the floor y = 0 of a domain of 100 m. Body 0 is the one that the answer speaks of.
core::Scene rigid_scene(std::string answer, double dt_s, double seconds);

// One friction and restitution for all bodies and faces; call it when all bodies are there.
void set_surfaces(core::Scene& scene, double friction, double restitution);

// Bodies get the mesh that was added last. The result is for further changes until the next body is added.
core::Body& add_box(core::Scene& scene, std::array<double, 3> sides_m, core::Vec3 position, double mass_kg = 1.0);
core::Body& add_ball(core::Scene& scene, double radius_m, core::Vec3 position, double mass_kg = 1.0);
// Along z, drawn with 64 sides.
core::Body& add_cylinder(core::Scene& scene, double radius_m, double half_length_m, core::Vec3 position,
                         double mass_kg = 1.0);
// A convex polygon, counterclockwise in x and y, drawn out to `depth_m` along z. Its coordinates are the world's: the
// mesh's origin is the middle of its box.
core::Body& add_prism(core::Scene& scene, const std::vector<std::array<double, 2>>& corners_m, double depth_m,
                      double mass_kg = 1.0);

inline constexpr double kStaticMass = 0.0;

// A plane through the origin that falls toward +x with this tangent, as a large static box; the domain's floor goes out
// of reach. Gives its outward normal and orientation, for what lies on it.
struct Slope {
  core::Vec3 normal;
  core::Quat orientation;
};
Slope slope_of(double tangent);
void add_slope(core::Scene& scene, const Slope& slope);

// The rotation by an angle about z, whose cosine is given, by a positive or negative angle.
core::Quat about_z(double cosine, bool is_negative);

}  // namespace broadside::datasets
