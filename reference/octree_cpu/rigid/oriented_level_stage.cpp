#include "reference/octree_cpu/rigid/oriented_level_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

#include "core/method/rigid/oriented_levels.hpp"
#include "reference/octree_cpu/rigid/push_stage.hpp"

namespace broadside::reference {

using core::Pair;

namespace {

bool meets(const core::RigidBodies& bodies, core::Levels levels, Pair pair, std::uint64_t& tests) {
  const core::RigidShape& a = bodies.shapes[bodies.shape[pair.i]];
  const core::RigidShape& b = bodies.shapes[bodies.shape[pair.j]];
  const core::RelativePose pose = core::relative_pose(bodies.pose(pair.i), a.balls.outer_m, bodies.pose(pair.j),
                                                      b.balls.outer_m, bodies.reach_m[pair.i] + bodies.reach_m[pair.j]);
  return core::is_confirmed(levels, a.nodes, b.nodes, pose, tests);
}

}  // namespace

void OrientedLevelStage::confirm(core::RigidBodies& bodies, core::Levels levels, std::span<const Pair> candidates,
                                 std::vector<Pair>& confirmed) {
  confirmed.clear();
  pairs_tested_.fetch_add(candidates.size(), std::memory_order_relaxed);
  keep_.resize(candidates.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64), [&](const auto& range) {
    std::uint64_t tests = 0;
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      note_pushes(bodies, candidates[k]);
      keep_[k] = meets(bodies, levels, candidates[k], tests) ? 1 : 0;
    }
    box_tests_.fetch_add(tests, std::memory_order_relaxed);
  });
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (keep_[k] != 0) confirmed.push_back(candidates[k]);
}

void OrientedLevelStage::confirm_all(core::RigidBodies& bodies, core::Levels levels, std::vector<Pair>& confirmed) {
  const std::uint32_t n = bodies.count();
  rows_.resize(n);
  // One row per body. Rows are joined in order, so the result is sorted whatever thread made which row.
  tbb::parallel_for(std::uint32_t{0}, n, [&](std::uint32_t i) {
    std::vector<Pair>& row = rows_[i];
    row.clear();
    std::uint64_t tests = 0;
    std::uint64_t tried = 0;
    for (std::uint32_t j = i + 1; j < n; ++j) {
      if (bodies.is_static[i] != 0 && bodies.is_static[j] != 0) continue;
      ++tried;
      if (!core::overlaps(bodies.boxes[i], bodies.boxes[j])) continue;
      note_pushes(bodies, {i, j});
      if (meets(bodies, levels, {i, j}, tests)) row.push_back({i, j});
    }
    pairs_tested_.fetch_add(tried, std::memory_order_relaxed);
    box_tests_.fetch_add(tests, std::memory_order_relaxed);
  });
  confirmed.clear();
  for (const std::vector<Pair>& row : rows_) confirmed.insert(confirmed.end(), row.begin(), row.end());
}

}  // namespace broadside::reference
