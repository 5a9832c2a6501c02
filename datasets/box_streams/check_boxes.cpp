#include "datasets/box_streams/check_boxes.hpp"

#include <cmath>
#include <utility>

namespace broadside::datasets {
namespace {

constexpr char kAxes[] = "xyz";

}  // namespace

core::Status check_boxes(std::span<const core::Box> boxes, const std::string& where) {
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const core::Box& box = boxes[n];
    const auto bad = [&](std::string what, std::string advice) {
      return core::Error{std::move(what), where + ": box " + std::to_string(n), std::move(advice)};
    };
    for (int k = 0; k < 3; ++k) {
      const std::string axis(1, kAxes[k]);
      if (!std::isfinite(box.min[k]) || !std::isfinite(box.max[k]))
        return bad("it is NaN or infinite on " + axis, "give finite bounds");
      if (box.min[k] > box.max[k]) return bad("its min is above its max on " + axis, "give min <= max");
    }
  }
  return core::Done{};
}

}  // namespace broadside::datasets
