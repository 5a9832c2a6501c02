// A recording in memory: mutants make them, and tamperings spoil them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/dynamics.hpp"
#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/statistics.hpp"
#include "core/trace/trace_header.hpp"
#include "core/verdict.hpp"

namespace broadside::bench {

struct Specimen {
  core::TraceHeader header;
  std::vector<core::FrameRecord> frames;
  std::vector<core::PenetrationStatistics> statistics;
  bool is_spoilable = true;  // false when a tampering found nothing of the kind that it spoils
};

// All frames of the scene, as octree-cpu declares itself. settings: canonical. Errors are the engine's.
core::Result<Specimen> record_specimen(const core::Scene& scene, core::Dynamics& dynamics, std::string_view settings);
// The same, as plain-rigid declares itself.
core::Result<Specimen> record_rigid_specimen(const core::Scene& scene, core::Dynamics& dynamics);
// The same, as octree-cpu declares itself where bodies turn.
core::Result<Specimen> record_turning_specimen(const core::Scene& scene, core::Dynamics& dynamics);

// As judge() does with files. only: validators; empty = all.
core::Result<std::vector<core::Verdict>> judge_specimen(const Specimen& subject, const Specimen* baseline,
                                                        std::vector<std::string> only = {});

}  // namespace broadside::bench
