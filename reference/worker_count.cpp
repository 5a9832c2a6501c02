#include "reference/worker_count.hpp"

#include <oneapi/tbb/info.h>

#include <algorithm>

namespace broadside::reference {

int worker_count(unsigned long setting) {
  const int cores = tbb::info::default_concurrency();
  return setting == 0 ? cores : static_cast<int>(std::min(setting, static_cast<unsigned long>(cores)));
}

core::SettingRow threads_setting() {
  return {"threads", "0", {}, "worker threads, at most one per core; 0 = all cores. The answers do not depend on it"};
}

}  // namespace broadside::reference
