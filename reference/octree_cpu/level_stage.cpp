#include "reference/octree_cpu/level_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace broadside::reference {

using core::Pair;

void LevelStage::confirm(const Bodies& bodies, core::Levels levels, std::span<const Pair> candidates,
                         std::vector<Pair>& confirmed) {
  confirmed.clear();
  pairs_tested_.fetch_add(candidates.size(), std::memory_order_relaxed);
  if (levels == core::Levels::kFlat) {
    confirmed.assign(candidates.begin(), candidates.end());
    return;
  }
  keep_.resize(candidates.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64), [&](const auto& range) {
    std::uint64_t tests = 0;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      const auto [i, j] = candidates[k];
      keep_[k] = core::is_confirmed(levels, bodies.shapes[bodies.shape[i]].boxes, bodies.state[i].x,
                                    bodies.shapes[bodies.shape[j]].boxes, bodies.state[j].x, tests);
    }
    box_tests_.fetch_add(tests, std::memory_order_relaxed);
  });
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (keep_[k] != 0) confirmed.push_back(candidates[k]);
}

void LevelStage::confirm_all(const Bodies& bodies, core::Levels levels, std::vector<Pair>& confirmed) {
  const std::uint32_t n = bodies.count();
  rows_.resize(n);
  const bool tests_leaves = levels == core::Levels::kA;
  if (tests_leaves) leaf_boxes_.place(bodies);
  // One row per body. Rows are joined in order, so the result is sorted whatever thread made which row.
  tbb::parallel_for(std::uint32_t{0}, n, [&](std::uint32_t i) {
    std::vector<Pair>& row = rows_[i];
    row.clear();
    std::uint64_t tests = 0;
    std::uint64_t tried = 0;
    const core::NodeBoxes& boxes = bodies.shapes[bodies.shape[i]].boxes;
    for (std::uint32_t j = i + 1; j < n; ++j) {
      if (bodies.is_static[i] != 0 && bodies.is_static[j] != 0) continue;
      ++tried;
      const bool is_kept = tests_leaves
                               ? leaf_boxes_.overlap(i, j, tests)
                               : core::is_confirmed(levels, boxes, bodies.state[i].x,
                                                    bodies.shapes[bodies.shape[j]].boxes, bodies.state[j].x, tests);
      if (is_kept) row.push_back({i, j});
    }
    box_tests_.fetch_add(tests, std::memory_order_relaxed);
    pairs_tested_.fetch_add(tried, std::memory_order_relaxed);
  });
  confirmed.clear();
  for (const auto& row : rows_) confirmed.insert(confirmed.end(), row.begin(), row.end());
}

}  // namespace broadside::reference
