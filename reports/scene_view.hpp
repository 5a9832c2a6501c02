// The rows of a run arranged as tables: for each scene engines are rows and validators are columns.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/coverage.hpp"
#include "core/rows.hpp"
#include "reports/timing.hpp"

namespace broadside::reports {

// One line of the verdict matrix: one trace, or a cell that left none. Pointers are into the rows it was made from.
struct TraceView {
  core::Stamp stamp;
  std::string label;                 // the stamp's, with the trace's file name where two labels would be equal
  const core::Cell* cell = nullptr;  // null for a trace that was judged without a recorded cell
  std::string trace_file;
  std::vector<std::string> baselines;  // labels, in order of appearance
  // One entry per validator of the scene. Each holds its verdicts, worst first, without repetitions (a trace that was
  // judged against two baselines has its verdicts without a baseline twice). Empty = no verdict.
  std::vector<std::vector<const core::Verdict*>> verdicts;

  bool is_simulation = false;                      // it moved bodies, so its motion needs a proof
  std::map<std::string, std::string> declaration;  // what the engine declared of itself

  [[nodiscard]] bool is_judged() const;
  [[nodiscard]] core::Coverage coverage() const;
  // Whether a law that ties motion to forces passed on a body that moved.
  [[nodiscard]] bool has_proven_motion() const;
  // The laws that had nothing to judge, grouped by reason: the reason, and the laws.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>> not_applied() const;
  // The words for the cells of a line without verdicts: "not measured: no device", "recorded, not judged".
  [[nodiscard]] std::string absence() const;
};

struct SceneView {
  std::string name;
  std::uint64_t digest = 0;
  std::vector<std::string> validators;  // columns, in order of first appearance
  std::vector<TraceView> traces;
  std::vector<Timing> timings;
  std::map<std::string, std::string> facts;  // notes with the same text in every cell that has notes
};

// What the scene's meshes stand in for, from the notes of its cells (a note "stand-in", or one that says "STAND-IN");
// empty when the meshes are those that were asked for.
std::string stand_in(const SceneView& scene);

// The rows must outlive the views.
std::vector<SceneView> by_scene(const core::RunRows& rows);

struct Tally {
  std::uint64_t passed = 0, failed = 0, inconclusive = 0, not_applicable = 0;  // verdicts
  std::uint64_t recorded = 0, absent = 0;                                      // cells
  std::uint64_t admitted = 0, struck_out = 0;                                  // times

  [[nodiscard]] std::uint64_t judged() const { return passed + failed + inconclusive; }
};
Tally tally(const std::vector<SceneView>& scenes);

// The result of the run in one sentence, for the top of every report. Plain text, not escaped.
std::string headline(const std::vector<SceneView>& scenes);

// Fail, inconclusive or pass over everything; not applicable when nothing was judged.
core::Outcome overall(const Tally& tally);

}  // namespace broadside::reports
