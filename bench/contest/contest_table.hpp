// Rows of a contest's cells as one table: scenes x engines x steps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bench/contest/contest_request.hpp"
#include "bench/contest/energy_curve.hpp"
#include "core/coverage.hpp"
#include "core/rows.hpp"

namespace broadside::bench::contest {

// The result of one engine on one scene at one step.
struct Entry {
  core::CellState state = core::CellState::kNotMeasured;
  std::string reason;  // of a cell that was not recorded
  core::Coverage coverage;
  std::vector<core::Verdict> broken;  // laws that failed
  core::Verdict nearest;              // of those that hold, the one that is nearest to its limit
  bool has_nearest = false;
  bool is_motion_proven = false;
  bool stands = false;  // rest applied and holds
  bool has_rest = false;
  double rest = 0.0;  // what rest measured; NaN where it did not apply
  std::string rest_unit;
  double deepest_m = 0.0;  // what penetration measured; NaN likewise
  std::string passage;  // what the law passage found: "held", "through", "undecided", "nothing met"; empty = not judged
  std::string passage_words;
  std::string trace_file;
  std::uint64_t last_digest = 0;  // of the last recorded frame
  // Against the scene's closed answer; NaN where it has none or the law did not apply.
  double error = 0.0;
  std::string error_unit;
  double cost = 0.0;     // s of the engine's steps a simulated second; NaN where it was not timed
  bool repeats = false;  // the timed run ended in the very digest that was recorded
  bool was_timed = false;
  double dt_s = 0.0;
};

struct SceneTable {
  std::string scene;               // without a step
  std::vector<std::string> steps;  // what stands after '@', in the order of the cells; "" = the scene's own
  std::map<std::string, std::map<std::string, Entry>> entries;  // by engine's label, by step
  std::map<std::string, EnergyCurve> energy;                    // by label, at the scene's own step
  // Of engines with a number of threads: the label without it, and the digests that its numbers ended in.
  std::map<std::string, std::set<std::uint64_t>> thread_digests;
};

struct ContestTable {
  std::vector<Entrant> entrants;  // columns; absent ones too
  std::vector<SceneTable> scenes;
  std::vector<SceneTable> fast_scenes;                                     // of passage_courses() alone
  std::uint32_t cells_at_once = 1;                                         // while they were timed
  std::map<std::string, std::map<std::string, std::string>> declarations;  // by label
  std::map<std::string, std::string> builds;                               // by label
};

// The scene's name and the step after '@'.
std::pair<std::string, std::string> name_and_step(const std::string& scene_name);

// steps: of each scene's own step, s, by the scene's name.
ContestTable contest_table(const core::RunRows& rows, const std::vector<Entrant>& entrants,
                           const std::map<std::string, double>& steps_s);

// Reads the traces of these scenes at their own steps, in this folder, and keeps the curves in FOLDER/energy.json. For
// a trace that is gone the kept curve is used, if there is one.
core::Status read_energy(ContestTable& table, const std::filesystem::path& folder,
                         const std::vector<std::string>& scenes);

// Null where this engine was not asked for the scene at its own step.
const Entry* own_entry(const SceneTable& scene, const std::string& engine);

// "9 broken: friction-cone, energy-growth" or "holds, 11 of 14"; the word of an absent cell and the first
// part of its reason.
std::string entry_text(const Entry& entry);

}  // namespace broadside::bench::contest
