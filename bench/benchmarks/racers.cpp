#include "bench/benchmarks/racers.hpp"

#include <algorithm>

#include "bench/engines.hpp"

namespace broadside::bench {
namespace {

constexpr std::uint32_t kMostBoxes = 1'000'000;

// Each engine of the table takes part with its defaults; these rows list the exceptions.
std::vector<Racer> exceptions() {
  return {
      {"all-pairs", "all-pairs", {}, 20'000},
      {"hash-cpu", "hash-cpu", {}, 20'000},  // its cell is a quarter of a meter, and the boxes are a meter and larger
      {"octree-cpu", "octree-cpu", {}, 10'000'000},
      {"octree-cpu-1-thread", "octree-cpu", {{"threads", "1"}}, 10'000'000},
      {"octree-cpu-complete", "octree-cpu", {{"broad", "octree"}}, 20'000},
      {"octree-gpu", "octree-gpu", {}, 10'000'000},
      {"embree-collide", "embree-collide", {}, 10'000'000},
      {"bullet-dbvt-deferred", "bullet-dbvt", {{"deferred", "on"}}, kMostBoxes},
      {"bullet-sap", "bullet-sap", {}, 10'000},  // inserts one box after another: quadratic
      {"fcl-sap", "fcl-sap", {}, 20'000},
  };
}

}  // namespace

const std::vector<Racer>& racers() {
  static const std::vector<Racer> all = [] {
    std::vector<Racer> rows = exceptions();
    for (const core::EngineRow& row : engines()) {
      const bool is_named = std::any_of(rows.begin(), rows.end(), [&](const Racer& r) { return r.name == row.id; });
      if (!is_named && row.capabilities.find("broad") != std::string_view::npos)
        rows.push_back({row.id, row.id, {}, kMostBoxes});
    }
    return rows;
  }();
  return all;
}

std::unique_ptr<core::BroadPhase> broad_phase_of(const Racer& racer, std::string& why) {
  const auto row = find_engine(racer.engine);
  if (!row) return why = row.error().line(), nullptr;
  if (why = why_absent(*row.value()); !why.empty()) return nullptr;
  auto settings = core::Settings::parse(row.value()->id, row.value()->settings, racer.settings);
  if (!settings) return why = settings.error().line(), nullptr;
  auto engine = row.value()->create(settings.value());
  if (!engine) return why = engine.error().line(), nullptr;
  return std::move(engine.value().broad_phase);
}

}  // namespace broadside::bench
