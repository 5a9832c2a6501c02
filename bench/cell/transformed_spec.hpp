// "two-body:unequal@mirrored-x": a scene and a transformation of it, for runs that metamorphic compares.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "core/scene/scene.hpp"

namespace broadside::bench {

struct TransformationRow {
  std::string_view name;
  std::string_view what;
  core::Scene (*apply)(const core::Scene&);
};

std::span<const TransformationRow> transformations();

// The text before the last '@' and the row named after it; the whole text and null when no row is named there, so that
// a file name may have an '@'.
std::pair<std::string_view, const TransformationRow*> split_transformation(std::string_view spec);

}  // namespace broadside::bench
