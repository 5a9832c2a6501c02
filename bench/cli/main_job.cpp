#include "bench/cli/main_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bench/build_facts.hpp"
#include "bench/cell/scene_meshes.hpp"
#include "bench/record/judging.hpp"
#include "bench/record/playback_of_trace.hpp"
#include "bench/record/run_plan.hpp"
#include "bench/timing/timing.hpp"
#include "reports/report.hpp"

namespace broadside::bench {
namespace {

// The cells that run, and what each is compared with after it was judged alone.
struct JobRow {
  std::string_view cell;
  std::array<std::string_view, 3> against;  // labels; empty = no more
};

constexpr std::string_view kPipeline = "octree-cpu";
constexpr JobRow kJob[] = {
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
};

core::Result<RunPlan> plan_of(const MainJob& job) {
  RunPlan plan;
  auto scene = job.scene.allow_stand_in ? make_scene_with_meshes(job.scene) : job.scene.make();
  if (!scene) return scene.error();
  plan.source = job.scene;
  plan.scene = std::move(scene).value();
  plan.frames = plan.scene.frames;
  plan.narrow_every = default_narrow_every(plan.frames);
  plan.folder = job.folder;
  plan.reuse = true;
  for (const JobRow& row : kJob) {
    auto cell = parse_cell_spec(row.cell);
    if (!cell) return cell.error();
    plan.cells.push_back(std::move(cell).value());
  }
  return plan;
}

const core::Cell* recorded(const std::vector<core::Cell>& cells, std::string_view label) {
  for (const core::Cell& cell : cells)
    if (cell.stamp.label() == label && !cell.trace_file.empty()) return &cell;
  return nullptr;
}

std::vector<Matter> matters_of(const MainJob& job, const std::vector<core::Cell>& cells) {
  std::vector<Matter> matters;
  for (const JobRow& row : kJob) {
    const core::Cell* cell = recorded(cells, row.cell);
    if (cell == nullptr) continue;
    matters.push_back({job.folder / cell->trace_file, {}, false, {}});
    for (const std::string_view label : row.against) {
      const core::Cell* baseline = label.empty() ? nullptr : recorded(cells, label);
      if (baseline != nullptr)
        matters.push_back({job.folder / cell->trace_file, job.folder / baseline->trace_file, true, {}});
    }
  }
  return matters;
}

core::Status judge_all(const MainJob& job, core::RunRows& rows) {
  rows.verdicts.clear();
  std::vector<core::EnergySeries> energy;
  for (Matter matter : matters_of(job, rows.cells)) {
    core::EnergySeries series;
    const bool is_pipeline = matter.trace.stem().string() == kPipeline;
    if (is_pipeline && matter.baseline.empty()) matter.energy = &series;
    auto judged = judge_matter(matter);
    if (!judged) return judged.error();
    if (!series.step.empty()) energy.push_back(std::move(series));
    if (!judged.value().verdicts.empty()) rows.verdicts.push_back(std::move(judged).value());
  }
  if (core::Status s = core::write_energy(job.folder / "energy.json", energy); !s) return s;
  return core::write_verdicts(job.folder / "verdicts.json", rows.verdicts);
}

core::Status time_all(const MainJob& job, const RunPlan& plan, core::RunRows& rows) {
  RunPlan timed = plan;
  // Only a recorded cell has a digest that a time can be checked against.
  std::vector<CellSpec> cells;
  for (std::size_t k = 0; k < std::size(kJob); ++k)
    if (recorded(rows.cells, kJob[k].cell) != nullptr) cells.push_back(plan.cells[k]);
  timed.cells = std::move(cells);
  Turns alone;
  auto samples = time_plan(timed, job.repetitions, alone);
  if (!samples) return samples.error();
  rows.samples = std::move(samples).value();
  return core::write_samples(job.folder / "samples.json", rows.samples);
}

// Whether this very program recorded it.
template <typename Row>
bool is_current(const std::vector<Row>& rows) {
  const std::string build = build_line();
  return !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [&](const Row& r) { return r.stamp.broadside_build == build; });
}

core::Status write_reports(const MainJob& job, const core::RunRows& rows) {
  auto energy = core::read_energy(job.folder);
  if (!energy) return energy.error();
  reports::ReportOptions options;
  options.energy = std::move(energy).value();
  options.title = job.scene.spec;
  options.command = fmt::format("./broadside demo --scene {} --out {}", job.scene.spec, job.folder.string());
  if (reports::has_html_page()) {
    options.playbacks = playbacks_of(rows, job.folder, share_of(1));
    options.series = penetration_of(rows, job.folder);
    if (core::Status s = reports::write_html(rows, options, job.folder / "report.html"); !s) return s;
  }
  if (core::Status s = reports::write_markdown(rows, options, job.folder / "report.md"); !s) return s;
  return reports::write_junit(rows, options, job.folder / "junit.xml");
}

}  // namespace

core::Result<core::RunRows> run_main_job(const MainJob& job) {
  if (core::Status s = prepare_folder(job.folder); !s) return s.error();
  auto plan = plan_of(job);
  if (!plan) return plan.error();
  auto outcome = run_plan(plan.value());
  if (!outcome) return outcome.error();
  auto known = core::read_rows(job.folder);
  if (!known) return known.error();
  core::RunRows rows = std::move(known).value();
  rows.cells = outcome.value().cells;
  for (const core::Cell& cell : rows.cells)
    if (cell.state == core::CellState::kInterrupted)
      return core::Error{"interrupted: what was recorded is in the folder, nothing was judged", job.folder.string(),
                         "run it again to go on", core::Exit::kMissing};

  const auto runnable = static_cast<std::uint64_t>(std::count_if(
      rows.cells.begin(), rows.cells.end(), [](const auto& c) { return c.state == core::CellState::kRecorded; }));
  const bool all_reused = outcome.value().reused == runnable;
  if (!all_reused || !is_current(rows.verdicts))
    if (core::Status s = judge_all(job, rows); !s) return s.error();
  const bool same_repetitions = !rows.samples.empty() && rows.samples.back().repetition + 1 == job.repetitions;
  if (!all_reused || !same_repetitions || !is_current(rows.samples))
    if (core::Status s = time_all(job, plan.value(), rows); !s) return s.error();
  if (core::Status s = write_reports(job, rows); !s) return s.error();
  return rows;
}

core::Exit exit_of(const core::RunRows& rows) {
  core::Exit exit = exit_of(rows.verdicts);
  if (exit != core::Exit::kGood) return exit;
  for (const core::Cell& cell : rows.cells)
    if (cell.state != core::CellState::kRecorded && cell.state != core::CellState::kNotMeasured &&
        cell.state != core::CellState::kUnsupported)
      return core::Exit::kMissing;
  return exit;
}

}  // namespace broadside::bench
