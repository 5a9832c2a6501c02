// Where an interrupted run can continue: the trace that it left, and the scene with the states of its last frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bench/cell/cell_request.hpp"
#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "core/trace/trace_header.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

struct ResumePoint {
  core::TraceReader trace;  // whose frames are part of the whole run
  core::Scene scene;        // the request's, except for the bodies' positions and velocities
  std::uint64_t step = 0;   // of the trace's last frame
  bool is_complete = false;
};

// Looks for NAME.h5.part, NAME.h5.interrupted and NAME.h5 (recovered, or complete) in the request's folder, and takes
// the file with the most frames; none = start anew. A .part is renamed to .interrupted first, so that a kill while its
// frames are copied loses nothing. Errors: a trace of another stamp, level or choice of steps; an engine with more
// state than that of its bodies; a file that is still being written.
core::Result<std::optional<ResumePoint>> find_resume_point(const CellRequest& request, const core::TraceHeader& wanted);

// The windows of steps that a trace was recorded in; empty = all steps.
std::string windows_of(const core::TraceHeader& header);

// The file that find_resume_point set aside; it is removed at the end of the run, whose trace has all its frames.
std::filesystem::path set_aside_path(const CellRequest& request, const core::Stamp& stamp);

}  // namespace broadside::bench
