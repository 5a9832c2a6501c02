#include "reference/octree_cpu/rigid/in_parallel.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace broadside::reference {

void parts_in_parallel(std::size_t grain, std::size_t first, std::size_t last,
                       const std::function<void(std::size_t, std::size_t)>& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, grain),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

}  // namespace broadside::reference
