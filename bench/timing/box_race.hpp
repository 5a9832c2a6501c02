// Broad phases side by side on a stream of boxes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "bench/process/child.hpp"
#include "core/result.hpp"
#include "datasets/box_streams/box_kind.hpp"

namespace broadside::bench {

// Sums over the frames; digest: the sum modulo 2^64 of the frames' pair digests, each mixed with its frame's number.
struct RaceRow {
  std::string label;
  std::uint64_t frames = 0;
  std::uint64_t boxes = 0;
  std::uint64_t pairs = 0;
  std::uint64_t raw = 0;
  std::uint64_t digest = 0;
  double update_s = 0.0;
  double find_s = 0.0;
  double filter_s = 0.0;     // part of read_back_s: filtering the engine's raw pairs on the given boxes
  double read_back_s = 0.0;  // copies, the engine's own filter, canonical order
  datasets::BoxKind kind;    // of the first frame
  std::uint32_t parts = 1;   // parts of space that were searched one after another
  std::uint64_t dealt = 0;   // boxes of all parts together, where there are several
  double cut_s = 0.0;        // part of update_s: choosing the cut and copying each part's boxes
  std::uint64_t most_pairs_at_once = 0;
  std::string path;     // how the engine searched the last frame; empty where it has one way
  std::string remark;   // on the set of the first frame, where its shape slows engines; else empty
  std::string absent;   // why a reference's process gave no answer; empty when it did
  std::string verdict;  // then how it failed: "abort", "time-out", ... (class_of in bench/process/child.hpp)
  std::string repeat;   // the command that repeats it; the boxes follow from their name, or are its file
};

// frames: at most so many; 0 = all of the stream. parts: parts of space; each is loaded, searched and handed on alone,
// and update_s contains cutting and loading. References run in child processes, and so do all engines where limits were
// asked for, unless `here` is set. Errors: interrupted, unknown or malformed boxes, an engine without a broad phase or
// without its device, an engine that fails in this process. An engine whose child process dies leaves a row that says
// so.
core::Result<std::vector<RaceRow>> race_boxes(const std::string& stream, const std::vector<CellSpec>& cells,
                                              std::uint32_t frames, std::uint32_t parts, const ChildLimits& limits,
                                              bool here);

// The rows as JSON, as the command prints them and as a child process passes them to its parent.
std::string race_json(const std::vector<RaceRow>& rows);

}  // namespace broadside::bench
