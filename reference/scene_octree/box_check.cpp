#include "reference/scene_octree/box_check.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace broadside::reference {

core::Error unsound_box(std::span<const core::Box> boxes) {
  const auto bad = std::find_if_not(boxes.begin(), boxes.end(), is_sound_box);
  return {"its bounds are not finite, or its min is above its max", "box " + std::to_string(bad - boxes.begin()),
          "give finite bounds with min <= max"};
}

core::Status check_boxes(std::span<const core::Box> boxes) {
  std::atomic<bool> sound = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 4096), [&](const auto& range) {
    bool all = true;
    for (std::size_t i = range.begin(); i != range.end(); ++i) all &= is_sound_box(boxes[i]);
    if (!all) sound = false;
  });
  if (!sound) return unsound_box(boxes);
  return core::Done{};
}

core::Status check_box_count(std::size_t given, std::size_t loaded) {
  if (given == loaded) return core::Done{};
  return core::Error{std::to_string(given) + " boxes were given, " + std::to_string(loaded) + " were loaded", "update",
                     "load again when the number of bodies changes", core::Exit::kInternal};
}

}  // namespace broadside::reference
