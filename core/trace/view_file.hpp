// Files for viewers: /VTKHDF with its own points, and XDMF text over a file that has /VTKHDF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>

#include "core/result.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::core {

enum class ViewOf : std::uint8_t {
  kBoxes,   // one hexahedron per body: its box at detection
  kLevel1,  // the non-empty boxes of the body octrees' level 1, at most 8 a body
  kLevel2,  // of level 2, at most 64 a body
  kMeshes,  // the bodies' triangles
};

struct ViewRequest {
  ViewOf of = ViewOf::kBoxes;
  // Selects recorded frames: steps first to last, every k-th of them.
  std::uint64_t first_step = 0;
  std::uint64_t last_step = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t every = 1;
};

struct ViewReport {
  std::uint64_t frames = 0;
  std::uint64_t cells = 0;  // the number in each frame
};

// Writes file, an HDF5 file that has only the group /VTKHDF, and its XDMF text beside it (extension .xdmf). The trace
// needs the group detection. Errors: the group is missing, no frame fits the request, or the disk refuses.
Result<ViewReport> write_view(const TraceReader& trace, const ViewRequest& request, const std::filesystem::path& file);

// XDMF text over the boxes that the trace file already has as virtual datasets: nothing is copied. The text refers to
// the trace by its file name, so both must be in one folder. Error: the trace has no such datasets (format 1, or
// written by another program).
Result<ViewReport> write_xdmf(const TraceReader& trace, const std::filesystem::path& xdmf);

}  // namespace broadside::core
