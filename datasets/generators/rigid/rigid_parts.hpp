// Parts from which the scenes with a known answer (`rigid:*`) are built.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace broadside::datasets {

// Standard gravity along -y, above the floor y = 0 of a domain of 100 m. Body 0 is the one to which the answer refers.
core::Scene rigid_scene(std::string answer, double dt_s, double seconds);

// Sets one friction and restitution for all bodies and faces; call it when all bodies have been added.
void set_surfaces(core::Scene& scene, double friction, double restitution);

// Bodies use the mesh that was added last. The result may be changed until the next body is added.
core::Body& add_box(core::Scene& scene, std::array<double, 3> sides_m, core::Vec3 position, double mass_kg = 1.0);
core::Body& add_ball(core::Scene& scene, double radius_m, core::Vec3 position, double mass_kg = 1.0);
// A cylinder along z, as a prism with 64 sides.
core::Body& add_cylinder(core::Scene& scene, double radius_m, double half_length_m, core::Vec3 position,
                         double mass_kg = 1.0);
// A convex polygon, counterclockwise in x and y, extruded by `depth_m` along z. Its coordinates are the world's: the
// mesh's origin is the middle of its box.
core::Body& add_prism(core::Scene& scene, const std::vector<std::array<double, 2>>& corners_m, double depth_m,
                      double mass_kg = 1.0);

inline constexpr double kStaticMass = 0.0;

// A plane through the origin that slopes down toward +x with this tangent, as a large static box; the domain's floor is
// moved out of reach. Returns its outward normal and its orientation, for bodies that lie on it.
struct Slope {
  core::Vec3 normal;
  core::Quat orientation;
};
Slope slope_of(double tangent);
void add_slope(core::Scene& scene, const Slope& slope);

// The rotation about z by an angle with the given cosine; the angle is positive or negative.
core::Quat about_z(double cosine, bool is_negative);

}  // namespace broadside::datasets
