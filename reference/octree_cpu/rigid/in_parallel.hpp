// A loop whose turns write to slots of their own, on the threads of the arena that it is called in.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace broadside::reference {

// Below twice this many, handing work to threads costs more than doing it: a patch or a body takes some hundred
// nanoseconds, waking a worker some microseconds.
inline constexpr std::size_t kTurnsPerTask = 64;

template <typename Work>
void in_parallel(std::size_t first, std::size_t last, const Work& work) {
  if (last - first < 2 * kTurnsPerTask) {
    for (std::size_t k = first; k < last; ++k) work(k);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, kTurnsPerTask), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) work(k);
  });
}

}  // namespace broadside::reference
