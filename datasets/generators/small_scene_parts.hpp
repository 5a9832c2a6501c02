// Parts from which the small scenes are built.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/scene/scene.hpp"

namespace broadside::datasets {

// A closed box cut every 1/8 m: the mean edge, and so theta, is about 0.14 m, while on a cube's face no point is
// farther than 0.09 m from a vertex. So vertex proximity finds faces that touch, wherever they touch (compare E13).
std::shared_ptr<const core::Mesh> cut_box(std::array<double, 3> sides_m);

// A domain of 8 m around the origin, so the cells of a two-level octree are 2 m wide; 1 m cubes; no gravity.
core::Scene around_origin(std::uint32_t frames);

// The same cubes over the floor y = 0 of a domain 24 m wide and 8 m high, with gravity.
core::Scene over_floor(std::uint32_t frames);

void add(core::Scene& scene, core::Vec3 position, core::Vec3 velocity, float inverse_mass = 1.0F,
         std::uint32_t mesh = 0);

inline constexpr float kStatic = 0.0F;

}  // namespace broadside::datasets
