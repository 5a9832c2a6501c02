#include "reports/admission.hpp"

#include <vector>

#include "reports/figures.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

std::vector<std::string> differences(const core::Stamp& a, const core::Stamp& b) {
  std::vector<std::string> names;
  if (a.scene_digest != b.scene_digest) names.emplace_back("scene");
  if (a.engine != b.engine) names.emplace_back("engine");
  if (a.settings != b.settings) names.emplace_back("settings");
  if (a.engine_build != b.engine_build) names.emplace_back("engine's build");
  if (a.broadside_build != b.broadside_build) names.emplace_back("build");
  if (a.machine != b.machine) names.emplace_back("machine");
  return names;
}

// Why no recording proves this sample: says what the recording that comes nearest lacks.
std::string why_no_cell(const core::Sample& sample, const core::RunRows& rows) {
  for (const core::Cell& cell : rows.cells)
    if (same_stamp(cell.stamp, sample.stamp)) return "the recording of the same stamp is " + state_text(cell);
  for (const core::Cell& cell : rows.cells) {
    const std::vector<std::string> names = differences(cell.stamp, sample.stamp);
    if (names.size() == 1) return "no recording of the same stamp: the recorded cell differs in its " + names[0];
  }
  return "no recording of the same stamp";
}

std::string at_place(const core::Place& place) {
  return place.step < 0 && place.bodies.empty() ? "" : " (worst at " + place_text(place) + ")";
}

// Why no law proved the motion: says, for each law that could have, what it found instead.
std::string why_unproven(const core::Stamp& stamp, const core::RunRows& rows) {
  std::string text;
  for (const core::CellVerdicts& cell : rows.verdicts) {
    if (!same_stamp(cell.stamp, stamp)) continue;
    for (const core::Verdict& verdict : cell.verdicts) {
      if (!verdict.ties_motion_to_forces || text.find(verdict.validator + ": ") != std::string::npos) continue;
      text += (text.empty() ? "" : "; ") + verdict.validator + ": ";
      text += verdict.outcome == core::Outcome::kNotApplicable ? verdict.explanation
              : verdict.outcome == core::Outcome::kPass        ? "passed, but on no body that moved"
                                                               : std::string(core::outcome_word(verdict.outcome));
    }
  }
  return "its motion was not proven (" + (text.empty() ? "no law of motion was asked for" : text) + ")";
}

}  // namespace

bool same_stamp(const core::Stamp& a, const core::Stamp& b) {
  return differences(a, b).empty();
}

Admission admit(const core::Sample& sample, const core::RunRows& rows) {
  bool is_recorded = false;
  bool has_frame = false;
  bool has_equal_digest = false;
  bool has_other_digest = false;
  std::uint64_t other_digest = 0;
  std::uint64_t last_step = 0;
  for (const core::Cell& cell : rows.cells) {
    if (cell.state != core::CellState::kRecorded || !same_stamp(cell.stamp, sample.stamp)) continue;
    is_recorded = true;
    if (!cell.digests.empty()) last_step = std::max(last_step, cell.digests.rbegin()->first);
    const auto found = cell.digests.find(sample.final_step);
    if (found == cell.digests.end()) continue;
    has_frame = true;
    if (found->second == sample.final_digest) {
      has_equal_digest = true;
    } else {
      has_other_digest = true;
      other_digest = found->second;
    }
  }
  if (!is_recorded) return {.reason = why_no_cell(sample, rows)};

  std::uint64_t passed = 0;
  bool has_motion = false;
  bool is_motion_proven = false;
  std::string caveat;
  for (const core::CellVerdicts& cell : rows.verdicts) {
    if (!same_stamp(cell.stamp, sample.stamp)) continue;
    has_motion |= cell.is_simulation;
    for (const core::Verdict& verdict : cell.verdicts) {
      is_motion_proven |= core::proves_motion(verdict);
      if (verdict.outcome == core::Outcome::kFail)
        return {.reason = verdict.validator + " failed on this stamp" + at_place(verdict.worst)};
      if (verdict.outcome == core::Outcome::kPass) ++passed;
      if (verdict.outcome == core::Outcome::kInconclusive && caveat.find(verdict.validator) == std::string::npos)
        caveat += (caveat.empty() ? "" : ", ") + verdict.validator;
    }
  }
  if (passed == 0) return {.reason = "nothing was proven: no validator passed on this stamp"};
  if (has_motion && !is_motion_proven) return {.reason = why_unproven(sample.stamp, rows)};

  const std::string step = std::to_string(sample.final_step);
  if (!has_frame)
    return {.reason = "the recording keeps no digest of step " + step +
                      ", where the timed run ended (its last is of step " + std::to_string(last_step) + ")"};
  // Refused even when another recording of the stamp agrees, because one stamp with two answers proves nothing.
  if (has_other_digest || !has_equal_digest)
    return {.reason = "the timed run's answer differs from the recording's at step " + step + " (digest " +
                      hexadecimal(sample.final_digest) + " against " + hexadecimal(other_digest) + ")"};
  return {.is_admitted = true, .caveat = caveat.empty() ? "" : "inconclusive: " + caveat};
}

}  // namespace broadside::reports
