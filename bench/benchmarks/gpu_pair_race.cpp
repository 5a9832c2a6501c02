// The GPU's broad phase on the boxes of the races: boxes on the device, pairs in memory, in any order. Prints one JSON
// line a set: medians over the repetitions, ms.
//   broadside_gpu_race [LARGEST_N [REPETITIONS [KIND]]]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/pair_finder.hpp"

namespace broadside::bench {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool race(const std::string& kind, std::uint32_t n, int repetitions) {
  auto made = datasets::make_box_stream("boxes:" + kind + ":" + std::to_string(n));
  if (!made) return fmt::print(stderr, "{}\n", made.error().line()), false;
  gpu::PairFinder finder({});
  const std::vector<std::uint8_t> is_static(made.value().boxes.size());
  if (core::Status s = finder.load(made.value().boxes, is_static); !s)
    return fmt::print(stderr, "{}\n", s.error().line()), false;
  std::vector<double> whole, count, place, scatter, find;
  for (int k = 0; k < repetitions + 3; ++k) {
    if (core::Status s = finder.find(); !s) return fmt::print(stderr, "{}\n", s.error().line()), false;
    if (k < 3) continue;  // the first finds how much room the pairs need
    const gpu::FindTime t = finder.find_time();
    whole.push_back(t.whole_s * 1e3), count.push_back(t.count_s * 1e3), place.push_back(t.place_s * 1e3);
    scatter.push_back(t.scatter_s * 1e3), find.push_back(t.find_s * 1e3);
  }
  auto pairs = finder.read_back();
  if (!pairs) return fmt::print(stderr, "{}\n", pairs.error().line()), false;
  const auto [least, most] = std::minmax_element(whole.begin(), whole.end());
  fmt::print(
      "{{\"boxes\": \"{}\", \"n\": {}, \"pairs\": {}, \"digest\": \"{:#018x}\", \"ms\": {:.4f}, \"least_ms\": {:.4f}, "
      "\"most_ms\": {:.4f}, \"count_ms\": {:.4f}, \"place_ms\": {:.4f}, \"scatter_ms\": {:.4f}, \"find_ms\": "
      "{:.4f}}}\n",
      kind, n, pairs.value().pairs.size(), core::pair_digest(pairs.value().pairs), median(whole), *least, *most,
      median(count), median(place), median(scatter), median(find));
  std::fflush(stdout);
  return true;
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  if (const std::string why = broadside::gpu::gpu_absent(); !why.empty()) return fmt::print(stderr, "{}\n", why), 3;
  const long largest = count > 1 ? std::atol(given[1]) : 1'000'000;
  const int repetitions = count > 2 ? std::max(1, std::atoi(given[2])) : 50;
  bool is_good = true;
  for (const std::string kind : {"uniform", "heaps", "mixed"})
    for (std::uint32_t n = 1000; n <= largest; n *= 10)
      if (count <= 3 || kind == given[3]) is_good = broadside::bench::race(kind, n, repetitions) && is_good;
  return is_good ? 0 : 1;
}
