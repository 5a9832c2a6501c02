#include "bench/paper/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <utility>

#include "bench/campaign/run_cells.hpp"
#include "bench/paper/cell_cost.hpp"
#include "bench/paper/paper_job.hpp"
#include "bench/process/interrupt.hpp"

namespace broadside::bench::paper {
namespace {

using Clock = std::chrono::steady_clock;

std::string minutes(double seconds) {
  return seconds < 90.0 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60.0);
}

}  // namespace

core::Result<std::vector<PaperRow>> run_campaign(const PaperRequest& request, const std::filesystem::path& folder) {
  auto manifest = campaign::make_manifest({"paper", {}, paper_job(request)});
  if (!manifest) return manifest.error();
  auto cells = planned_cells(request, manifest.value().cells);
  if (!cells) return cells.error();
  if (core::Status s = campaign::write_manifest(folder, manifest.value()); !s) return s.error();

  // The expected time of each cell that is not finished, and how the forecast compares with the time so far.
  std::vector<double> expected_s;
  for (std::size_t k = 0; k < cells.value().size(); ++k) {
    std::error_code ignored;
    const bool is_done = std::filesystem::exists(campaign::cell_folder(folder, manifest.value().cells[k].id), ignored);
    expected_s.push_back(is_done ? 0.0 : expected_seconds(cells.value()[k], request.plan.runs));
  }
  const double whole_s = std::accumulate(expected_s.begin(), expected_s.end(), 0.0);
  std::size_t done = static_cast<std::size_t>(std::count(expected_s.begin(), expected_s.end(), 0.0));
  double done_s = 0.0;
  if (whole_s > 0.0)
    fmt::print(
        stderr,
        "paper: {} of {} cells, about {} left, if this machine is as fast as the one that costs were measured on\n",
        done, cells.value().size(), minutes(whole_s));
  const auto start = Clock::now();
  const auto tell = [&](const campaign::GroupEnd& end) {
    for (std::size_t k = end.first; k < end.first + end.cells.size(); ++k) {
      if (expected_s[k] > 0.0) ++done;
      done_s += std::exchange(expected_s[k], 0.0);
    }
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
    // The longer this machine has worked, the more its own pace weighs in the forecast.
    constexpr double kKnown_s = 10.0;
    const double left_s = (whole_s - done_s) * (elapsed_s + kKnown_s) / (done_s + kKnown_s);
    fmt::print(stderr, "paper: {} of {} cells, {} so far{}\n", done, cells.value().size(), minutes(elapsed_s),
               done < cells.value().size() ? fmt::format(", about {} left", minutes(left_s)) : "");
  };
  auto tally = campaign::run_cells(folder, {}, tell);
  if (!tally) return tally.error();
  if (is_interrupted())
    return core::Error{"interrupted: finished cells are kept", folder.string(), "the same command goes on from there",
                       core::Exit::kMissing};
  return rows_of(cells.value(), folder);
}

}  // namespace broadside::bench::paper
