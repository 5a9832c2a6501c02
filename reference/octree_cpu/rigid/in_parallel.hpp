// A loop whose iterations write to slots of their own, run by the threads of the arena in which it is called.
#pragma once

#include <cstddef>
#include <functional>

namespace broadside::reference {

// A loop of fewer than twice this many iterations runs on one thread, because handing work to threads would cost more
// than doing it: a patch or a body takes some hundred nanoseconds, waking a worker some microseconds.
inline constexpr std::size_t kTurnsPerTask = 64;
// The same for tiles of patches; a tile takes as long as two or three patches one by one.
inline constexpr std::size_t kTilesPerTask = 16;

// work(first, last) for parts of the range, of `grain` iterations each, from several threads at once.
void parts_in_parallel(std::size_t grain, std::size_t first, std::size_t last,
                       const std::function<void(std::size_t, std::size_t)>& work);

// The same, on this thread alone where that is faster.
template <typename Work>
void in_parallel_by(std::size_t grain, std::size_t first, std::size_t last, const Work& work) {
  if (last - first >= 2 * grain)
    parts_in_parallel(grain, first, last, work);
  else if (last > first)
    work(first, last);
}

// work(k) for each k of the range.
template <typename Work>
void in_parallel(std::size_t first, std::size_t last, const Work& work) {
  in_parallel_by(kTurnsPerTask, first, last, [&work](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) work(k);
  });
}

}  // namespace broadside::reference
