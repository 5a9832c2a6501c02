// A loop whose turns write to slots of their own, on the threads of the arena that it is called in.
#pragma once

#include <cstddef>
#include <functional>

namespace broadside::reference {

// Below twice this many, handing work to threads costs more than doing it: a patch or a body takes some hundred
// nanoseconds, waking a worker some microseconds.
inline constexpr std::size_t kTurnsPerTask = 64;

// work(first, last) for parts of the range, from several threads at once.
void parts_in_parallel(std::size_t first, std::size_t last, const std::function<void(std::size_t, std::size_t)>& work);

// work(k) for each k of the range.
template <typename Work>
void in_parallel(std::size_t first, std::size_t last, const Work& work) {
  const auto part = [&work](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) work(k);
  };
  if (last - first < 2 * kTurnsPerTask)
    part(first, last);
  else
    parts_in_parallel(first, last, part);
}

}  // namespace broadside::reference
