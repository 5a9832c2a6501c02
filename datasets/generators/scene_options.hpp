// Options that a caller may set for any scene, built in or from a file.
#pragma once

#include <cstdint>
#include <optional>

#include "datasets/mesh/acquire_mesh.hpp"

namespace broadside::datasets {

struct SceneOptions {
  MeshOptions meshes = MeshOptions::from_environment();
  std::optional<std::uint32_t> frames;  // instead of the scene's own
  std::optional<std::uint64_t> seed;    // instead of the scene's own
};

// Broad-phase scenes go up to ten million boxes; one body takes about 100 bytes of state.
inline constexpr std::uint32_t kMaxBodies = 10'000'000;
// METHOD section 9: each of the paper's runs is averaged over 3000 frames.
inline constexpr std::uint32_t kPaperFrames = 3000;
// The default seed of every seeded scene; any fixed number would do.
inline constexpr std::uint64_t kDefaultSeed = 1;
// Standard gravity to the digits that the method's scenes use, along -y. In m/s^2.
inline constexpr core::Vec3 kGravity{0.0F, -9.81F, 0.0F};

}  // namespace broadside::datasets
