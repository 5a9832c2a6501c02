// "two-body:unequal@mirrored-x": a scene and a transformation of it, for runs that the law metamorphic compares.
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

// The text before the last '@', and the table row that is named after it. Where no row has that name, the whole text
// and null, so that a file name may contain an '@'.
std::pair<std::string_view, const TransformationRow*> split_transformation(std::string_view spec);

}  // namespace broadside::bench
