// Compares broad phases as sources of candidate pairs for continuous collision.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "bench/process/child.hpp"
#include "core/continuous/moving_surface.hpp"
#include "core/result.hpp"

namespace broadside::bench {

struct MotionSource {
  std::string start;  // a name of datasets/motions/, or a mesh file with the start of the step
  std::string end;    // the same mesh at the end of the step; empty when start is a name
};

// Errors: an unknown name, files that cannot be read, meshes that do not have the same triangles.
core::Result<continuous::MovingSurface> make_surface(const MotionSource& source);

struct CandidateRow {
  std::string label;
  std::uint64_t triangles = 0;
  std::uint64_t pairs = 0;  // of triangles whose swept boxes overlap
  std::uint64_t vertex_face = 0;
  std::uint64_t edge_edge = 0;
  std::uint64_t digest = 0;
  double pairs_s = 0.0;        // load, find and read back
  double candidates_s = 0.0;   // makes the candidates of these pairs
  std::uint64_t touching = 0;  // candidates that touch; set only where impacts are timed
  std::uint64_t impacts = 0;   // the digest of all candidates with the bits of their times
  double first_touch = 2.0;    // the earliest time, in units of the step; 2 where nothing touches
  double impacts_s = 0.0;      // for all times
  double earliest_s = 0.0;     // for the earliest one alone
  std::string absent;          // why a reference's process gave no answer; empty when it did
  std::string verdict;         // the kind of failure, when absent is set: "abort", "time-out", ...
  std::string repeat;          // the command that repeats the failure
};

// The candidates that one engine finds, in this process.
core::Result<continuous::FeaturePairs> candidates_by(const CellSpec& cell, const continuous::MovingSurface& surface,
                                                     const continuous::SurfaceFeatures& features, CandidateRow& row);

// Computes the first touches of the candidates on every core and puts them into the row. Error: the earliest one is not
// the least of all, which is a fault of this program.
core::Status time_impacts(const continuous::MovingSurface& surface, const continuous::SurfaceFeatures& features,
                          const continuous::FeaturePairs& pairs, CandidateRow& row);

// References run in child processes, unless `here` is set. Errors: interrupted, an engine without a broad phase or
// without its device, an engine that fails in this process. try_all: adds a row for all pairs of features, without a
// broad phase.
core::Result<std::vector<CandidateRow>> race_candidates(const MotionSource& source, const std::vector<CellSpec>& cells,
                                                        bool try_all, const ChildLimits& limits, bool here);

// The rows as JSON, as the command prints them and as a child process passes them to its parent.
std::string candidates_json(const std::vector<CandidateRow>& rows);

}  // namespace broadside::bench
