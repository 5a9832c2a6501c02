// What a validator is: a law, checked over the frames of a trace, that ends in one verdict. It never calls an engine.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/trace/frame.hpp"
#include "core/trace/statistics.hpp"
#include "core/trace/trace_header.hpp"
#include "core/verdict.hpp"

namespace broadside::validation {

struct Motion;

// One frame of the subject, the subject's frame before it (null at the first, or when frames between were not
// recorded), and the baseline's frame of the same step (null when there is no baseline or it lacks that step).
struct Evidence {
  const core::FrameRecord& frame;
  const core::FrameRecord* previous = nullptr;
  const core::FrameRecord* baseline = nullptr;
  // The step in float64 (validation/mechanics/motion.hpp), for validators whose row asks for it; null where the frame
  // before was not recorded.
  const Motion* motion = nullptr;
};

// Lives for one pass over one trace. Frames come in rising order of step; memory must not grow with their number.
class Validator {
 public:
  virtual ~Validator() = default;
  virtual void look(const Evidence& evidence) = 0;
  virtual core::Verdict conclude() = 0;
};

struct Subject {
  const core::TraceHeader& header;
  const core::TraceHeader* baseline = nullptr;
  std::uint64_t frame_count = 0;                                         // the subject's recorded frames
  const std::vector<core::PenetrationStatistics>* statistics = nullptr;  // the subject's rows; null = not told
  bool is_cut_off = false;  // the subject's file was not finished: it may lack the statistics of its last windows
};

// One row per validator in the one table (validation/validators.inc).
struct ValidatorRow {
  std::string_view name;
  std::string_view law;               // holds when
  std::string_view must_reject;       // the known-bad engine or trace
  std::uint32_t groups = 0;           // of the subject that look() reads
  std::uint32_t baseline_groups = 0;  // of the baseline; 0 when it needs none
  // Why it does not apply to this subject and baseline; empty when it does.
  std::string (*why_not)(const Subject& subject);
  std::unique_ptr<Validator> (*make)(const Subject& subject);
  // Its baseline runs a transformed scene (validation/scene_relation.hpp); other validators never get such a baseline.
  bool compares_scenes = false;
  bool reads_motion = false;
  // The law says how forces move bodies: where it passes on a body that moved, the motion is proven.
  bool ties_motion_to_forces = false;
  core::LawKind kind = core::LawKind::kTrace;  // by the line in validators.inc
};

}  // namespace broadside::validation
