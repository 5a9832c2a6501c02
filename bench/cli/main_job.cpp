#include "bench/cli/main_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/cli/job_part.hpp"
#include "bench/contest/contest_request.hpp"
#include "bench/record/judging.hpp"
#include "bench/record/playback_of_trace.hpp"
#include "core/energy_series.hpp"
#include "reports/report.hpp"

namespace broadside::bench {
namespace {

constexpr const char* kTurningFolder = "turning";
constexpr const char* kPipeline = "octree-cpu";

JobPart first_part(const MainJob& job) {
  return {job.scene,
          {
              {kPipeline, {"octree-cpu[threads=1]", "all-pairs", "fcl-mesh"}},
              {"octree-cpu[threads=1]", {}},
              {"octree-cpu[broad=brute,levels=flat]", {kPipeline}},
              {"octree-cpu[broad=brute,levels=level1]", {kPipeline}},
              {"octree-cpu[broad=brute,levels=A]", {kPipeline}},
              {"octree-cpu[broad=brute,levels=B]", {kPipeline}},
              {"octree-cpu[broad=brute]", {kPipeline}},  // levels=C, the default, from the published start
              {"all-pairs", {}},
              {"bullet-dbvt", {"all-pairs"}},
              {"fcl-tree", {"all-pairs"}},
              {"fcl-mesh", {}},
              {"hash-cpu", {}},
              {"octree-gpu", {kPipeline}},
          },
          kPipeline,
          job.folder,
          job.repetitions};
}

// The engines of a contest, each with its default settings.
JobPart turning_part(const MainJob& job) {
  JobPart part{job.turning, {}, "", job.folder / kTurningFolder, job.repetitions};
  for (const std::string_view entrant : contest::default_entrants())
    if (entrant.find('[') == std::string_view::npos) part.rows.push_back({std::string(entrant), {}});
  return part;
}

// The path, relative to the job's folder, of a file in the turning scene's folder.
std::string moved_up(const std::string& file) {
  return file.empty() ? file : fmt::format("{}/{}", kTurningFolder, file);
}

core::RunRows moved_up(core::RunRows rows) {
  for (core::Cell& cell : rows.cells) cell.trace_file = moved_up(cell.trace_file);
  for (core::CellVerdicts& row : rows.verdicts) row.trace_file = moved_up(row.trace_file);
  return rows;
}

template <typename T>
void append_all(std::vector<T>& to, std::vector<T> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Takes the rows whose label is among these, or those whose label is not.
core::RunRows selected(const core::RunRows& rows, const std::vector<std::string>& labels, bool is_among) {
  const auto is_other = [&](const auto& row) {
    return (std::find(labels.begin(), labels.end(), row.stamp.label()) != labels.end()) != is_among;
  };
  core::RunRows chosen = rows;
  std::erase_if(chosen.cells, is_other);
  std::erase_if(chosen.verdicts, is_other);
  std::erase_if(chosen.samples, is_other);
  return chosen;
}

core::RunRows joined(core::RunRows rows, core::RunRows more) {
  append_all(rows.cells, std::move(more.cells));
  append_all(rows.verdicts, std::move(more.verdicts));
  append_all(rows.samples, std::move(more.samples));
  return rows;
}

// Adds what the page shows of the traces. The rows have the file names of their own folders.
core::Status add_pictures(const MainJob& job, const core::RunRows& first, const core::RunRows& turning,
                          reports::ReportOptions& options) {
  auto energy = core::read_energy(job.folder);
  if (!energy) return energy.error();
  options.energy = std::move(energy).value();
  options.series = penetration_of(first, job.folder);
  options.playbacks = playbacks_of(first, job.folder, share_of(2));
  // All runs are shown, because on this scene the motions are compared.
  PlaybackShare all_runs = share_of(2);
  all_runs.every_run = true;
  all_runs.most_runs = turning.cells.size();
  for (reports::Playback& playback : playbacks_of(turning, job.folder / kTurningFolder, all_runs)) {
    playback.trace_file = moved_up(playback.trace_file);
    options.playbacks.push_back(std::move(playback));
  }
  return core::Done{};
}

core::Status write_reports(const MainJob& job, const core::RunRows& first, const core::RunRows& turning,
                           const MainJobRows& rows) {
  reports::ReportOptions options;
  options.title = fmt::format("{}, and {}", job.scene.spec, job.turning.spec);
  options.note = fmt::format(
      "On {} engines made by others are compared: laws that they break are listed too, but do not decide the exit "
      "code of demo.",
      job.turning.spec);
  options.command = fmt::format("./broadside demo --scene '{}' --turning-scene '{}' --out {}", job.scene.spec,
                                job.turning.spec, job.folder.string());
  if (reports::has_html_page()) {
    if (core::Status s = add_pictures(job, first, turning, options); !s) return s;
    if (core::Status s = reports::write_html(rows.all, options, job.folder / "report.html"); !s) return s;
  }
  if (core::Status s = reports::write_markdown(rows.all, options, job.folder / "report.md"); !s) return s;
  return reports::write_junit(rows.deciding, options, job.folder / "junit.xml");
}

}  // namespace

core::Result<MainJobRows> run_main_job(const MainJob& job) {
  auto first = run_part(first_part(job));
  if (!first) return first.error();
  const JobPart turning_job = turning_part(job);
  auto turning = run_part(turning_job);
  if (!turning) return turning.error();
  auto foreign = foreign_labels(turning_job);
  if (!foreign) return foreign.error();

  const core::RunRows seen = moved_up(turning.value());
  MainJobRows rows;
  rows.all = joined(first.value(), seen);
  rows.deciding = joined(first.value(), selected(seen, foreign.value(), false));
  rows.others = selected(seen, foreign.value(), true);
  if (core::Status s = write_reports(job, first.value(), turning.value(), rows); !s) return s.error();
  return rows;
}

core::Exit exit_of(const MainJobRows& rows) {
  core::Exit exit = exit_of(rows.deciding.verdicts);
  if (exit != core::Exit::kGood) return exit;
  for (const core::Cell& cell : rows.deciding.cells)
    if (cell.state != core::CellState::kRecorded && cell.state != core::CellState::kNotMeasured &&
        cell.state != core::CellState::kUnsupported)
      return core::Exit::kMissing;
  return exit;
}

}  // namespace broadside::bench
