// A row in the table of scenes: a name, options, and the function that makes the scene.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "core/scene/scene.hpp"

namespace broadside::datasets {

// A number that a scene's name or file may set: "tower:cube:20[offset=0.2]".
struct SceneKnob {
  std::string_view key;
  double usual;
  double low;  // allowed: low to high, both included
  double high;
  std::string_view what;
};

// The inputs from which a family makes its scene.
struct GivenScene {
  std::shared_ptr<const core::Mesh> model;  // of the requested size, its box centered on the origin
  std::uint32_t count;
  std::uint64_t seed;
  std::span<const double> knobs;  // in the order of the family's knobs
};

struct SceneFamily {
  std::string_view name;     // "tower"
  std::string_view pattern;  // "tower:MESH:N"
  std::string_view example;
  std::string_view what;
  std::uint32_t frames;  // unless told otherwise
  std::span<const SceneKnob> knobs;
  // A pure function. Sets everything except name, description, frames and seed.
  core::Scene (*make)(const GivenScene& given);
};

}  // namespace broadside::datasets
