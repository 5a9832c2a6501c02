#include "reference/worker_count.hpp"

#include <oneapi/tbb/info.h>

#include <algorithm>

namespace broadside::reference {

int worker_count(unsigned long setting) {
  const int cores = tbb::info::default_concurrency();
  return setting == 0 ? cores : static_cast<int>(std::min(setting, static_cast<unsigned long>(cores)));
}

}  // namespace broadside::reference
