#include "bench/cli/job_part.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "bench/build_facts.hpp"
#include "bench/cell/scene_meshes.hpp"
#include "bench/record/judged_traces.hpp"
#include "bench/record/judging.hpp"
#include "bench/record/run_plan.hpp"
#include "bench/timing/timing.hpp"

namespace broadside::bench {
namespace {

core::Result<RunPlan> plan_of(const JobPart& part) {
  RunPlan plan;
  auto scene = part.scene.allow_stand_in ? make_scene_with_meshes(part.scene) : part.scene.make();
  if (!scene) return scene.error();
  plan.source = part.scene;
  plan.scene = std::move(scene).value();
  plan.frames = plan.scene.frames;
  plan.narrow_every = default_narrow_every(plan.frames);
  plan.folder = part.folder;
  plan.reuse = true;
  for (const PartRow& row : part.rows) {
    auto cell = parse_cell_spec(row.cell);
    if (!cell) return cell.error();
    plan.cells.push_back(std::move(cell).value());
  }
  return plan;
}

const core::Cell* recorded(const std::vector<core::Cell>& cells, std::string_view label) {
  for (const core::Cell& cell : cells)
    if (cell.stamp.label() == label && cell.state == core::CellState::kRecorded && !cell.trace_file.empty())
      return &cell;
  return nullptr;
}

struct PartMatter {
  Matter matter;
  bool has_ledger = false;
};

std::vector<PartMatter> matters_of(const JobPart& part, const RunPlan& plan, const std::vector<core::Cell>& cells) {
  std::vector<PartMatter> matters;
  for (std::size_t k = 0; k < part.rows.size(); ++k) {
    const core::Cell* cell = recorded(cells, label_of(plan.cells[k]));
    if (cell == nullptr) continue;
    const std::filesystem::path trace = part.folder / cell->trace_file;
    matters.push_back({{trace, {}, false, {}}, part.rows[k].cell == part.ledger_of});
    for (const std::string& label : part.rows[k].against)
      if (const core::Cell* baseline = recorded(cells, label); baseline != nullptr)
        matters.push_back({{trace, part.folder / baseline->trace_file, true, {}}, false});
  }
  return matters;
}

core::Status judge_all(const JobPart& part, const RunPlan& plan, core::RunRows& rows) {
  rows.verdicts.clear();
  std::vector<core::EnergySeries> energy;
  for (PartMatter& m : matters_of(part, plan, rows.cells)) {
    core::EnergySeries series;
    if (m.has_ledger) m.matter.energy = &series;
    auto judged = judge_matter(m.matter);
    if (!judged) return judged.error();
    if (!series.step.empty()) energy.push_back(std::move(series));
    if (!judged.value().verdicts.empty()) rows.verdicts.push_back(std::move(judged).value());
  }
  if (core::Status s = core::write_energy(part.folder / "energy.json", energy); !s) return s;
  return core::write_verdicts(part.folder / "verdicts.json", rows.verdicts);
}

core::Status time_all(const JobPart& part, const RunPlan& plan, core::RunRows& rows) {
  RunPlan timed = plan;
  // Only a recorded cell has a digest that a time can be checked against.
  std::erase_if(timed.cells, [&](const CellSpec& spec) { return recorded(rows.cells, label_of(spec)) == nullptr; });
  Turns alone;
  auto samples = time_plan(timed, part.repetitions, alone);
  if (!samples) return samples.error();
  rows.samples = std::move(samples).value();
  return core::write_samples(part.folder / "samples.json", rows.samples);
}

// Whether these samples were timed by this very build of the program.
bool is_current(const std::vector<core::Sample>& samples) {
  const std::string build = build_line();
  return !samples.empty() && std::all_of(samples.begin(), samples.end(), [&](const core::Sample& sample) {
    return sample.stamp.broadside_build == build;
  });
}

}  // namespace

core::Result<core::RunRows> run_part(const JobPart& part) {
  if (core::Status s = prepare_folder(part.folder); !s) return s.error();
  const JudgedTraces judged(part.folder);
  if (core::Status s = judged.drop_changed_rows(); !s) return s.error();
  auto plan = plan_of(part);
  if (!plan) return plan.error();
  auto outcome = run_plan(plan.value());
  if (!outcome) return outcome.error();
  auto known = core::read_rows(part.folder);
  if (!known) return known.error();
  core::RunRows rows = std::move(known).value();
  rows.cells = outcome.value().cells;
  for (const core::Cell& cell : rows.cells)
    if (cell.state == core::CellState::kInterrupted)
      return core::Error{"interrupted: what was recorded is in the folder, nothing was judged", part.folder.string(),
                         "run it again to go on", core::Exit::kMissing};

  const auto runnable = static_cast<std::uint64_t>(std::count_if(
      rows.cells.begin(), rows.cells.end(), [](const auto& c) { return c.state == core::CellState::kRecorded; }));
  const bool all_reused = outcome.value().reused == runnable;
  const auto are_judged = judged.are_of(rows.cells);
  if (!are_judged) return are_judged.error();
  if (!all_reused || !are_judged.value()) {
    if (core::Status s = judge_all(part, plan.value(), rows); !s) return s.error();
    if (core::Status s = judged.keep(rows.cells); !s) return s.error();
  }
  const bool same_repetitions = !rows.samples.empty() && rows.samples.back().repetition + 1 == part.repetitions;
  if (!all_reused || !same_repetitions || !is_current(rows.samples))
    if (core::Status s = time_all(part, plan.value(), rows); !s) return s.error();
  return rows;
}

core::Result<std::vector<std::string>> foreign_labels(const JobPart& part) {
  std::vector<std::string> labels;
  for (const PartRow& row : part.rows) {
    auto cell = parse_cell_spec(row.cell);
    if (!cell) return cell.error();
    if (cell.value().row->runs_in_child) labels.push_back(label_of(cell.value()));
  }
  return labels;
}

}  // namespace broadside::bench
