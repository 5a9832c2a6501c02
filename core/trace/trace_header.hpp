// The part of a trace that applies to all of its frames.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/engine/declaration.hpp"
#include "core/scene/scene.hpp"
#include "core/stamp.hpp"
#include "core/trace/frame.hpp"

namespace broadside::core {

// Increased whenever a reader of the previous version would misread a file. CHANGELOG.md lists the breaks. Format 1,
// which has no declaration, can still be opened (core/trace/format1.hpp).
constexpr std::uint32_t kTraceFormatVersion = 2;

struct TraceHeader {
  Stamp stamp;
  Declaration declaration;  // of the engine that made the trace
  Scene scene;
  std::uint32_t groups = 0;  // bit(Group) of each group that the frames have
  RecordLevel level = RecordLevel::kFull;
  std::uint32_t every = 1;  // every k-th frame was recorded
  // Whether the broad phase is exact, where the trace has pairs.
  bool broad_is_exact = true;
  double broad_margin_m = 0.0;
  // The engine whose boxes or poses were fed to a broad-phase or narrow-phase engine: "octree-cpu"; empty for a trace
  // of dynamics.
  std::string driver;
  // Any other information, as printed in the report's equivalence card: "theta_m" -> "0.0312".
  std::map<std::string, std::string> notes;
};

}  // namespace broadside::core
