#include "bench/paper/campaign.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "bench/campaign/run_cells.hpp"
#include "bench/interrupt.hpp"
#include "bench/paper/cell_files.hpp"

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

core::Result<std::vector<PaperRow>> run_campaign(const PaperRequest& request, const std::filesystem::path& folder) {
  auto manifest = campaign::make_manifest({"paper", {}, request});
  if (!manifest) return manifest.error();
  auto cells = campaign::paper_cells(manifest.value());
  if (!cells) return cells.error();
  if (core::Status s = campaign::write_manifest(folder, manifest.value()); !s) return s.error();

  std::vector<double> weight_before{0.0};
  for (const PaperCell& cell : cells.value()) weight_before.push_back(weight_before.back() + weight_of(cell));
  double measured = 0.0;  // groups that were finished before say nothing about the pace
  const auto start = Clock::now();
  const auto tell = [&](const campaign::GroupEnd& end) {
    const std::size_t next = end.next_place;
    measured += weight_before[next] - weight_before[next - end.cells.size()];
    const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    const double left = elapsed / measured * (weight_before.back() - weight_before[next]);
    fmt::print(stderr, "paper: {} of {} cells, {} so far{}\n", next, cells.value().size(), minutes(elapsed),
               left > 0.0 ? fmt::format(", about {} left", minutes(left)) : "");
  };
  auto tally = campaign::run_cells(folder, {}, tell);
  if (!tally) return tally.error();
  if (is_interrupted())
    return core::Error{"interrupted: finished cells are kept", folder.string(), "the same command goes on from there",
                       core::Exit::kMissing};
  return rows_of_campaign(manifest.value(), folder);
}

core::Result<std::vector<PaperRow>> rows_of_campaign(const campaign::Manifest& manifest,
                                                     const std::filesystem::path& folder) {
  auto cells = campaign::paper_cells(manifest);
  if (!cells) return cells.error();
  const CellFiles files(folder);
  std::vector<PaperRow> rows;
  for (const PaperCell& cell : cells.value()) rows.push_back(files.row(cell));
  return rows;
}

}  // namespace broadside::bench::paper
