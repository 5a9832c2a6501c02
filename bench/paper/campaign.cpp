#include "bench/paper/campaign.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <iterator>

#include "bench/interrupt.hpp"

namespace broadside::bench::paper {
namespace {

using Clock = std::chrono::steady_clock;

// Rough work of a cell's frame, relative to 50 bunnies that fall: for the estimate of the time left, never for a
// result.
double weight_of(const PaperCell& cell) {
  const double pairs = 0.5 * cell.count * (cell.count - 1.0);
  const double tests = cell.method == "A" || cell.method == "level 2"   ? 4096.0
                       : cell.method == "B" || cell.method == "level 1" ? 64.0
                                                                        : 1.0;
  const double vertices = cell.model == "asian_dragon" ? 30.0 : cell.model == "bunny" ? 1.0 : 4.0;
  const double loading = cell.model == "asian_dragon" ? 1000.0 : cell.model == "bunny" ? 10.0 : 100.0;
  return loading + static_cast<double>(cell.frames) * (1.0 + 0.02 * cell.count * vertices / 4.0 + pairs * tests * 2e-7);
}

std::string minutes(double seconds) {
  return seconds < 90.0 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60.0);
}

}  // namespace

core::Result<std::vector<PaperRow>> run_campaign(const std::vector<PaperCell>& cells, const MeasureOptions& options) {
  double all = 0.0;
  for (const PaperCell& cell : cells) all += weight_of(cell);
  double done = 0.0;
  double taken_over = 0.0;  // weight of groups that were finished before: they say nothing about the pace
  const auto start = Clock::now();
  std::vector<PaperRow> rows;
  for (std::size_t first = 0; first < cells.size();) {
    std::size_t end = first;
    double weight = 0.0;
    const auto is_same_scene = [&](const PaperCell& c) {
      const PaperCell& f = cells[first];
      return c.scene == f.scene && c.beta == f.beta && c.delta_m == f.delta_m && c.frames == f.frames &&
             c.every == f.every;
    };
    while (end < cells.size() && is_same_scene(cells[end])) weight += weight_of(cells[end++]);

    bool was_measured = false;
    MeasureOptions own = options;
    own.progress = [&](double) { was_measured = true; };
    auto group = measure_group(std::span(cells).subspan(first, end - first), own);
    if (!group) return group.error();
    rows.insert(rows.end(), std::make_move_iterator(group.value().begin()),
                std::make_move_iterator(group.value().end()));
    done += weight;
    if (!was_measured) taken_over += weight;
    first = end;
    const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    const double measured = done - taken_over;
    if (was_measured || first == cells.size())
      fmt::print(stderr, "paper: {} of {} cells, {} so far{}\n", first, cells.size(), minutes(elapsed),
                 first < cells.size() && measured > 0.0
                     ? fmt::format(", about {} left", minutes(elapsed / measured * (all - done)))
                     : "");
    if (is_interrupted() && first < cells.size())
      return core::Error{"interrupted: finished cells are kept", options.folder.string(),
                         "the same command goes on from there", core::Exit::kMissing};
  }
  return rows;
}

}  // namespace broadside::bench::paper
