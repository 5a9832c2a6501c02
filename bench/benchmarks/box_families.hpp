// The sets of boxes of the broad-phase suites, by name and number.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/math/box.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/box_sweeps.hpp"

namespace broadside::bench {

inline constexpr std::uint64_t kSeed = 1;

// One set that a suite runs on. `path` names it in the benchmark's name: "uniform/10000", "density/0.1/1000000".
struct BoxSet {
  std::string path;
  std::uint32_t count;
  std::vector<core::Box> (*make)(std::uint32_t count, double value);
  double value;      // the property that the sweep varies; 0 where none is
  std::string spec;  // a name of datasets::make_box_stream, instead of `make`

  // Empty where the set cannot be made on this machine, because it lacks the mesh.
  [[nodiscard]] std::vector<core::Box> boxes() const {
    if (spec.empty()) return make(count, value);
    auto stream = datasets::make_box_stream(spec, kSeed);
    return stream.ok() ? std::move(stream).value().boxes : std::vector<core::Box>{};
  }
};

// The three kinds of box sets of the race, at each of these counts.
inline std::vector<BoxSet> race_sets(const std::vector<std::uint32_t>& counts) {
  std::vector<BoxSet> sets;
  for (const std::uint32_t n : counts) {
    const std::string tail = "/" + std::to_string(n);
    sets.push_back(
        {"uniform" + tail, n, [](std::uint32_t c, double) { return datasets::uniform_boxes(c, kSeed); }, 0, {}});
    sets.push_back({"heaps" + tail, n, [](std::uint32_t c, double) { return datasets::heap_boxes(c, kSeed); }, 0, {}});
    sets.push_back({"mixed" + tail, n, [](std::uint32_t c, double) { return datasets::mixed_boxes(c, kSeed); }, 0, {}});
  }
  return sets;
}

// Some 100,000 boxes of surfaces, long and thin, spread unevenly.
inline std::vector<BoxSet> hard_sets() {
  constexpr std::uint32_t kCount = 100'000;
  std::vector<BoxSet> sets;
  for (const char* name : {"mesh:dragon", "mesh:bunny:20", "sheet:100000", "slivers:100000", "needles:100000",
                           "spiral:100000", "cantor:100000"})
    sets.push_back({name, kCount, nullptr, 0, std::string("boxes:") + name});
  return sets;
}

// One property varied at a fixed count: a sudden slowdown shows as a step in the time per box.
inline std::vector<BoxSet> sweep_sets(std::uint32_t count) {
  std::vector<BoxSet> sets;
  const auto add = [&](const char* name, const char* value, auto make) {
    sets.push_back({std::string(name) + "/" + value + "/" + std::to_string(count), count, make, std::stod(value), {}});
  };
  for (const char* density : {"0.01", "0.1", "1", "4"})
    add("density", density, [](std::uint32_t c, double v) { return datasets::boxes_of_density(c, kSeed, v); });
  for (const char* ratio : {"1", "10", "100", "1000"})
    add("size_ratio", ratio, [](std::uint32_t c, double v) { return datasets::boxes_of_size_ratio(c, kSeed, v); });
  for (const char* gap : {"1", "8", "64", "512"})
    add("gap", gap, [](std::uint32_t c, double v) { return datasets::boxes_of_gap(c, kSeed, v); });
  return sets;
}

}  // namespace broadside::bench
