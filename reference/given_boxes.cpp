#include "reference/given_boxes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

namespace broadside::reference {
namespace {

using core::Box;
using core::Error;
using core::Pair;

bool is_finite(core::Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_ordered(const Box& b) {
  return b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z;
}

}  // namespace

core::Status GivenBoxes::load(std::string_view engine, std::span<const Box> boxes,
                              std::span<const std::uint8_t> is_static) {
  const std::string where = std::string(engine) + ": load";
  if (boxes.size() != is_static.size()) {
    return Error{std::to_string(boxes.size()) + " boxes but " + std::to_string(is_static.size()) + " static marks",
                 where, "give one mark per box", core::Exit::kInternal};
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!is_finite(boxes[i].min) || !is_finite(boxes[i].max) || !is_ordered(boxes[i])) {
      return Error{"box " + std::to_string(i) + " is not finite or has min > max", where,
                   "give boxes with finite min <= max on every axis"};
    }
  }
  boxes_.assign(boxes.begin(), boxes.end());
  is_static_.assign(is_static.begin(), is_static.end());
  return core::Done{};
}

core::Status GivenBoxes::update(std::string_view engine, std::span<const Box> boxes) {
  if (boxes.size() != boxes_.size()) {
    return Error{std::to_string(boxes.size()) + " boxes where " + std::to_string(boxes_.size()) + " were loaded",
                 std::string(engine) + ": update", "load again when bodies come or go", core::Exit::kInternal};
  }
  std::copy(boxes.begin(), boxes.end(), boxes_.begin());
  return core::Done{};
}

core::PairSet GivenBoxes::tighten(std::vector<Pair> raw) const {
  core::PairSet set;
  set.raw = raw.size();
  const auto start = std::chrono::steady_clock::now();
  std::erase_if(raw, [&](Pair p) {
    return (is_static_[p.i] != 0 && is_static_[p.j] != 0) || !core::overlaps(boxes_[p.i], boxes_[p.j]);
  });
  set.filter_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::sort(raw.begin(), raw.end());
  raw.erase(std::unique(raw.begin(), raw.end()), raw.end());
  set.pairs = std::move(raw);
  set.demanded = set.pairs.size();
  return set;
}

}  // namespace broadside::reference
