#include "bench/paper/motion_proof.hpp"

#include <algorithm>
#include <string>

#include "bench/record/judging.hpp"
#include "reports/admission.hpp"
#include "validation/judge.hpp"

namespace broadside::bench::paper {
namespace {

// Few steps, because every frame is written, and enough steps for bodies to fall and meet.
constexpr std::uint64_t kSteps = 20;

}  // namespace

core::Result<std::vector<core::Verdict>> verdicts_of_first_steps(const RunPlan& plan, const CellSpec& spec,
                                                                 const core::Stamp& stamp) {
  RunPlan start = plan;
  start.cells = {spec};
  start.frames = std::min(kSteps, plan.frames);
  start.selection = {};
  start.folder = plan.folder / "first-steps";
  if (core::Status s = prepare_folder(start.folder); !s) return s.error();
  auto outcome = run_plan(start);
  if (!outcome) return outcome.error();
  const core::Cell& cell = outcome.value().cells.back();
  std::vector<core::Verdict> verdicts;
  if (cell.state != core::CellState::kRecorded || !reports::same_stamp(cell.stamp, stamp)) return verdicts;
  std::vector<std::string> laws;
  for (const validation::ValidatorRow& row : validation::validators())
    if (row.ties_motion_to_forces) laws.emplace_back(row.name);
  auto judged = judge_matter({start.folder / cell.trace_file, {}, false, laws});
  if (!judged) return judged.error();
  verdicts = std::move(judged.value().verdicts);
  std::erase_if(verdicts, [](const core::Verdict& v) { return v.outcome == core::Outcome::kNotApplicable; });
  for (core::Verdict& verdict : verdicts)
    verdict.explanation += "; of steps 1 to " + std::to_string(start.frames) + ", recorded in a row";
  return verdicts;
}

}  // namespace broadside::bench::paper
