// Where the time of a search for pairs went.
#pragma once

#include <cstddef>

#include "gpu/frame/frame_kernel.hpp"

namespace broadside::gpu {

// `whole_s` is the time between two events around the launches, or 0 if no events were set. The steps are read off the
// GPU's clock within that time. Several passes give their sums.
struct FindTime {
  double whole_s = 0.0;
  double count_s = 0.0;    // boxes into cells
  double place_s = 0.0;    // cells into memory
  double scatter_s = 0.0;  // boxes by cell
  double find_s = 0.0;

  void add_steps(const Outcome& outcome) {
    const auto seconds = [&outcome](FindStep step) {
      const auto k = static_cast<std::size_t>(step);
      const unsigned long long begin_ns = k == 0 ? outcome.begin_ns : outcome.stage_end_ns[k - 1];
      return static_cast<double>(outcome.stage_end_ns[k] - begin_ns) * 1e-9;
    };
    count_s += seconds(FindStep::kCount);
    place_s += seconds(FindStep::kPlace);
    scatter_s += seconds(FindStep::kScatter);
    find_s += seconds(FindStep::kSearch);
  }
  [[nodiscard]] double steps_s() const { return count_s + place_s + scatter_s + find_s; }
};

}  // namespace broadside::gpu
