#include "bench/shrink/shrink_boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/shrink/minimal_subset.hpp"
#include "bench/shrink/simpler_scene.hpp"
#include "validation/overlap_join.hpp"

namespace broadside::bench {
namespace {

using core::Box;
using core::Pair;

// With up to so many boxes, comparing all pairs takes less than a millisecond.
constexpr std::size_t kFewBoxes = 1000;

std::vector<Pair> overlapping(const std::vector<Box>& boxes) {
  if (boxes.size() > kFewBoxes) return validation::OverlapJoin().join(boxes, {});
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

bool is_box(const Box& b) {
  return b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z;
}

struct Wrong {
  bool is_error = false;
  std::vector<Pair> missed;
  std::vector<Pair> extra;
};

class BoxShrinker {
 public:
  BoxShrinker(const PairFinder& find, const ShrinkLimits& limits) : find_(find), limits_(limits) {}

  core::Result<ShrunkBoxes> run(const std::vector<Box>& boxes) {
    const std::optional<Wrong> whole = judge(boxes);
    if (!whole)
      return core::Error{"the engine finds exactly the overlapping pairs", fmt::format("{} boxes", boxes.size()),
                         "there is nothing to shrink"};
    wrong_ = *whole;
    best_ = boxes;
    for (std::uint64_t before = ~std::uint64_t{0}; before != changes_ && !is_spent();) {
      before = changes_;
      drop_boxes();
      shift();
      drop_digits();
    }
    return ShrunkBoxes{std::move(best_), std::move(wrong_.missed), std::move(wrong_.extra), trials_, elapsed_s(),
                       is_spent()};
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  [[nodiscard]] bool is_spent() const { return elapsed_s() > limits_.time_s || is_interrupted(); }

  std::optional<Wrong> judge(const std::vector<Box>& boxes) {
    ++trials_;
    const auto found = find_(boxes);
    if (!found) return Wrong{true, {}, {}};
    std::vector<Pair> given = found.value();
    std::sort(given.begin(), given.end());
    const std::vector<Pair> exact = overlapping(boxes);
    Wrong wrong;
    std::set_difference(exact.begin(), exact.end(), given.begin(), given.end(), std::back_inserter(wrong.missed));
    std::set_difference(given.begin(), given.end(), exact.begin(), exact.end(), std::back_inserter(wrong.extra));
    if (wrong.missed.empty() && wrong.extra.empty()) return std::nullopt;
    return wrong;
  }

  // An engine that stops with an error has another fault than one that finds other pairs.
  bool take(const std::vector<Box>& boxes) {
    if (!std::all_of(boxes.begin(), boxes.end(), is_box)) return false;
    std::optional<Wrong> wrong = judge(boxes);
    if (!wrong || wrong->is_error != wrong_.is_error) return false;
    best_ = boxes;
    wrong_ = std::move(*wrong);
    ++changes_;
    return true;
  }

  void tell() const {
    if (limits_.tell) limits_.tell(fmt::format("{} boxes ({} runs, {:.1f} s)", best_.size(), trials_, elapsed_s()));
  }

  static std::vector<Box> chosen(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& ids) {
    std::vector<Box> part;
    part.reserve(ids.size());
    for (const std::uint32_t id : ids) part.push_back(boxes[id]);
    return part;
  }

  void drop_boxes() {
    const std::vector<Box> whole = best_;
    const std::vector<Pair>& pairs = wrong_.missed.empty() ? wrong_.extra : wrong_.missed;
    if (!pairs.empty()) {
      const Pair p = pairs.front();
      if (whole.size() > 2 && take(chosen(whole, {p.i, p.j}))) return tell();
    }
    std::vector<std::uint32_t> all(whole.size());
    std::iota(all.begin(), all.end(), 0U);
    minimal_subset(
        std::move(all), [&](const std::vector<std::uint32_t>& part) { return take(chosen(whole, part)); },
        [&] { return is_spent(); });
    tell();
  }

  void shift() {
    if (best_.empty() || best_.front().min == core::Vec3{}) return;
    const core::Vec3 by = best_.front().min;
    std::vector<Box> moved = best_;
    for (Box& b : moved) b = {b.min - by, b.max - by};
    take(moved);
  }

  void drop_digits() {
    for (std::size_t k = 0; k < 6 * best_.size() && !is_spent(); ++k)
      for (int digits = 0; digits < kAllDigits && !is_spent(); ++digits) {
        std::vector<Box> rounded = best_;
        Box& box = rounded[k / 6];
        float& value = k % 6 < 3 ? box.min[static_cast<int>(k % 3)] : box.max[static_cast<int>(k % 3)];
        const float before = value;
        value = rounded_to(value, digits);
        if (value == before || take(rounded)) break;
      }
    tell();
  }

  const PairFinder& find_;
  const ShrinkLimits& limits_;
  Clock::time_point start_ = Clock::now();
  std::uint64_t trials_ = 0;
  std::uint64_t changes_ = 0;
  std::vector<Box> best_;
  Wrong wrong_;
};

}  // namespace

core::Result<ShrunkBoxes> shrink_boxes(const std::vector<Box>& boxes, const PairFinder& find,
                                       const ShrinkLimits& limits) {
  return BoxShrinker(find, limits).run(boxes);
}

}  // namespace broadside::bench
