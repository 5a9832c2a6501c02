// Runs every validator that applies over one trace in one streamed pass.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/verdict.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {

// The one table of validators.
std::span<const ValidatorRow> validators();

struct JudgeOptions {
  // Names to run; empty = all. Unknown names are an error with the nearest known one.
  std::vector<std::string> only;
  // Called now and then with the frames done and the frames in all.
  std::function<void(std::uint64_t, std::uint64_t)> progress;
  // Called with every frame that the pass reads; these groups are read beside those of the validators.
  std::function<void(const Evidence&)> observe;
  std::uint32_t observed_groups = 0;
};

// Where frames come from: a trace file, or frames in memory. header and steps outlive the pass.
struct FrameSource {
  const core::TraceHeader& header;
  std::span<const std::uint64_t> steps;  // rising
  // Frame by index, with at least the asked-for groups that the header names. Called from one thread at a time, not
  // always the same one, while validators on other threads look at an earlier frame.
  std::function<core::Result<core::FrameRecord>(std::uint64_t index, std::uint32_t groups)> read;
  std::vector<core::PenetrationStatistics> statistics = {};
  bool is_cut_off = false;  // the file was not finished
};

// One verdict per validator, in the table's order; those that do not apply say why. With a baseline, validators that
// need one compare; the others judge the subject alone. The two scenes must have the same digest, or the baseline's
// scene must be the subject's, transformed (validation/scene_relation.hpp); only metamorphic sees such a baseline.
// Frames of the baseline are matched by step; at most four frames are in memory at a time.
core::Result<std::vector<core::Verdict>> judge(const core::TraceReader& trace, const core::TraceReader* baseline,
                                               const JudgeOptions& options);
core::Result<std::vector<core::Verdict>> judge(const FrameSource& subject, const FrameSource* baseline,
                                               const JudgeOptions& options);

}  // namespace broadside::validation
