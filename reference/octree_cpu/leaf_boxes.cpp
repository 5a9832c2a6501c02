#include "reference/octree_cpu/leaf_boxes.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <limits>

namespace broadside::reference {
namespace {

using Columns = LeafBoxes::Columns;

// Floats of one AVX register: columns are read in such steps.
constexpr std::uint32_t kLane = 8;

constexpr std::uint32_t in_lanes(std::uint32_t count) {
  return (count + kLane - 1) / kLane * kLane;
}

core::Box box_of(const Columns& c, std::uint32_t k) {
  return {{c.bounds[0][k], c.bounds[1][k], c.bounds[2][k]}, {c.bounds[3][k], c.bounds[4][k], c.bounds[5][k]}};
}

// The number of the first box of a that overlaps one of b's; a.count when none does. A row of b's boxes is tested
// without a branch, so that it becomes vector code; only comparisons are used, so every instruction set gives the same
// answer.
#if defined(BROADSIDE_HAS_AVX2_KERNEL)
__attribute__((target_clones("avx2", "default")))
#endif
std::uint32_t
first_overlapping_row(const Columns& a, const Columns& b) {
  const std::uint32_t columns = in_lanes(b.count);
  const float* const min_x = b.bounds[0].data();
  const float* const min_y = b.bounds[1].data();
  const float* const min_z = b.bounds[2].data();
  const float* const max_x = b.bounds[3].data();
  const float* const max_y = b.bounds[4].data();
  const float* const max_z = b.bounds[5].data();
  for (std::uint32_t p = 0; p < a.count; ++p) {
    const float low_x = a.bounds[0][p], low_y = a.bounds[1][p], low_z = a.bounds[2][p];
    const float high_x = a.bounds[3][p], high_y = a.bounds[4][p], high_z = a.bounds[5][p];
    int hits = 0;
    for (std::uint32_t q = 0; q < columns; ++q)
      hits |= static_cast<int>(low_x <= max_x[q]) & static_cast<int>(min_x[q] <= high_x) &
              static_cast<int>(low_y <= max_y[q]) & static_cast<int>(min_y[q] <= high_y) &
              static_cast<int>(low_z <= max_z[q]) & static_cast<int>(min_z[q] <= high_z);
    if (hits != 0) return p;
  }
  return a.count;
}

}  // namespace

void LeafBoxes::place(const Bodies& bodies) {
  of_body_.resize(bodies.count());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, bodies.count(), 64), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) {
      const core::NodeBoxes& boxes = bodies.shapes[bodies.shape[i]].boxes;
      Columns& columns = of_body_[i];
      columns.count = boxes.level2_count;
      for (std::uint32_t k = 0; k < in_lanes(columns.count); ++k) {
        const bool is_box = k < columns.count;
        const core::Box box = is_box ? core::translated(boxes.level2[k], bodies.state[i].x) : core::Box{};
        for (int axis = 0; axis < 3; ++axis) {
          constexpr float kNever = std::numeric_limits<float>::infinity();
          columns.bounds[axis][k] = is_box ? box.min[axis] : kNever;
          columns.bounds[axis + 3][k] = is_box ? box.max[axis] : -kNever;
        }
      }
    }
  });
}

bool LeafBoxes::overlap(std::uint32_t i, std::uint32_t j, std::uint64_t& tests) const {
  const Columns& a = of_body_[i];
  const Columns& b = of_body_[j];
  const std::uint32_t row = first_overlapping_row(a, b);
  tests += std::uint64_t{row} * b.count;
  if (row == a.count) return false;
  std::uint32_t q = 0;
  while (!core::overlaps(box_of(a, row), box_of(b, q))) ++q;
  tests += q + 1;
  return true;
}

}  // namespace broadside::reference
