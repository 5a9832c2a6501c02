#include "bench/forensics/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bench/forensics/flight_rule.hpp"
#include "bench/forensics/flight_text.hpp"
#include "bench/forensics/replay_rule.hpp"
#include "bench/process/child.hpp"
#include "bench/record/record.hpp"
#include "bench/record/resume.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::bench {
namespace {

using core::bit;
using core::Group;

constexpr double kTimeLimit_s = 3600.0;

struct Feed {
  std::string_view capability;
  std::uint32_t groups;  // that the trace must have
  std::string_view lacks;
};
constexpr std::array kFeeds{
    Feed{"broad", bit(Group::kDetection) | bit(Group::kPairs), "boxes at detection and candidate pairs"},
    Feed{"narrow", bit(Group::kDetection) | bit(Group::kNarrow), "poses at detection and measured separations"},
};

bool has(const core::TraceReader& trace, std::uint32_t groups) {
  return (trace.header().groups & groups) == groups;
}

// True for a simulation: the trace has states, or digests alone, and no other trace drove its engine.
bool is_simulation(const core::TraceReader& trace) {
  return trace.header().driver.empty() && (trace.header().groups == 0 || has(trace, bit(Group::kBodies)));
}

core::Result<std::string> choose(const core::TraceReader& trace, const CellSpec& engine, const std::string& asked) {
  const std::string where = trace.path().string();
  if (!asked.empty() && !offers(*engine.row, asked))
    return core::Error{"it offers " + std::string(engine.row->capabilities), std::string(engine.row->id),
                       "choose another engine, or leave --as out"};
  if ((asked.empty() || asked == "dynamics") && offers(*engine.row, "dynamics") && is_simulation(trace))
    return std::string("dynamics");
  if (asked == "dynamics") return core::Error{"it is no trace of a simulation", where, "give one with body states"};
  for (const Feed& feed : kFeeds) {
    if (!offers(*engine.row, feed.capability) || (!asked.empty() && asked != feed.capability)) continue;
    if (has(trace, feed.groups)) return std::string(feed.capability);
    if (!asked.empty()) return core::Error{"it has no " + std::string(feed.lacks), where, "record these groups"};
  }
  return core::Error{fmt::format("it has nothing that {} ({}) could repeat", engine.row->id, engine.row->capabilities),
                     where, "a broad phase needs boxes and pairs, a narrow phase poses and separations"};
}

// The steps that the trace has. The replay must record the same steps, because they also decide what a frame holds: a
// body octree that is the same in all recorded steps is recorded once.
core::Result<StepSelection> selection_of(const core::TraceReader& trace) {
  const std::string windows = windows_of(trace.header());
  std::vector<std::string> each;
  for (std::size_t at = 0; at < windows.size();) {
    const std::size_t end = std::min(windows.find(',', at), windows.size());
    each.push_back(windows.substr(at, end - at));
    at = end + 1;
  }
  return StepSelection::parse(std::max(1U, trace.header().every), each);
}

enum class Steps { kOfTheTrace, kAll };

core::Result<std::filesystem::path> record_again(const core::TraceReader& trace, const core::Scene& scene,
                                                 const CellSpec& engine, const std::string& capability,
                                                 const std::filesystem::path& folder, Steps steps) {
  CellRequest request;
  request.source.spec = trace.path().string();
  request.scene = &scene;
  request.row = engine.row;
  request.settings = engine.settings;
  request.frames = scene.frames;
  request.level = trace.header().groups == 0 ? core::RecordLevel::kDigest : core::RecordLevel::kFull;
  request.folder = folder;
  request.driver_trace = trace.path();
  if (capability == "dynamics" && steps == Steps::kOfTheTrace) {
    auto selection = selection_of(trace);
    if (!selection) return selection.error();
    request.selection = std::move(selection).value();
  }
  auto cell =
      engine.row->runs_in_child ? record_cell_in_child(request, {kTimeLimit_s}) : record_cell(request, capability);
  if (!cell) return cell.error();
  if (cell.value().state != core::CellState::kRecorded)
    return core::Error{std::string(core::cell_state_word(cell.value().state)) + ": " + cell.value().reason,
                       std::string(engine.row->id), "", core::Exit::kMissing};
  return folder / cell.value().trace_file;
}

// Steps that only the replay has are not a difference, because it records every step. The replay has no initial state:
// that is the scene's.
core::Status compare_by(DifferenceRule& rule, const core::TraceReader& a, const core::TraceReader& b, Replay& replay) {
  auto found = compare_traces(a, b, &rule);
  if (!found) return found.error();
  replay.difference = std::move(found).value();
  replay.difference.only_in_b = 0;
  const bool has_start = a.steps().front() == 0 && b.steps().front() != 0;
  if (has_start) --replay.difference.only_in_a;
  return core::Done{};
}

core::Status compare_pairs(const core::TraceReader& a, const core::TraceReader& b, Replay& replay) {
  PairRule rule(a.header().broad_is_exact);
  replay.expectation = "the recorded boxes have exactly these pairs, as a set";
  if (core::Status s = compare_by(rule, a, b, replay); !s) return s;
  if (rule.extra() > 0)
    replay.remark =
        fmt::format("{} pairs are only in the recording, whose engine does not promise exact pairs", rule.extra());
  return core::Done{};
}

core::Status compare_separations(const core::TraceReader& a, const core::TraceReader& b, Replay& replay) {
  SeparationRule rule(a.header().scene);
  replay.expectation =
      "distances of surfaces that are apart agree within 2 sqrt(3) u (W_A + W_B), u = 2^-24, W a body's largest "
      "coordinate; touching agrees outside that band";
  if (core::Status s = compare_by(rule, a, b, replay); !s) return s;
  replay.has_judged = rule.judged() > 0;
  return core::Done{};
}

core::Status compare_flights(const core::TraceReader& a, const core::TraceReader& b, Replay& replay) {
  FlightRule rule(a, b);
  replay.expectation = flight_expectation(a.header(), b.header());
  if (core::Status s = compare_by(rule, a, b, replay); !s) return s;
  if (!rule.error().empty()) return core::Error{rule.error()};
  replay.has_judged = rule.judged() > 0;
  replay.remark = flight_remark(rule, a.header(), b.header());
  return core::Done{};
}

core::Status compare_simulations(const core::TraceReader& a, const core::TraceReader& b, Replay& replay) {
  if (!validation::are_twins(a.header(), b.header())) {
    if (a.header().groups == 0)
      return core::Error{"it records only digests, and those of different engines cannot be compared",
                         a.path().string(), "record it with --record full"};
    return compare_flights(a, b, replay);
  }
  DifferenceRule bits;
  replay.expectation = "the same method on the same scene: every bit agrees";
  return compare_by(bits, a, b, replay);
}

core::Result<core::TraceReader> repeat(const core::TraceReader& trace, const core::Scene& scene, const CellSpec& engine,
                                       Replay& replay, const std::filesystem::path& folder) {
  const auto record = [&](Steps steps) -> core::Result<core::TraceReader> {
    auto file = record_again(trace, scene, engine, replay.capability, folder, steps);
    if (!file) return file.error();
    replay.file = file.value();
    return core::TraceReader::open(replay.file);
  };
  auto own = record(Steps::kOfTheTrace);
  // Bits are compared step by step, but a bound between two engines grows with every step, also in steps left out of
  // the trace.
  const bool is_sparse = trace.steps().back() > trace.frame_count();
  const bool is_foreign = own && !validation::are_twins(trace.header(), own.value().header());
  if (replay.capability != "dynamics" || !is_sparse || !is_foreign) return own;
  return record(Steps::kAll);
}

}  // namespace

core::Result<Replay> replay_trace(const std::filesystem::path& trace, const CellSpec& engine,
                                  const std::string& capability, const std::filesystem::path& folder) {
  auto recorded = core::TraceReader::open(trace);
  if (!recorded) return recorded.error();
  const core::TraceReader& a = recorded.value();
  if (a.frame_count() == 0) return core::Error{"it has no frames", trace.string(), "record at least one step"};
  auto chosen = choose(a, engine, capability);
  if (!chosen) return chosen.error();
  Replay replay;
  replay.capability = chosen.value();
  core::Scene scene = a.header().scene;
  if (replay.capability == "dynamics") scene.frames = static_cast<std::uint32_t>(a.steps().back());
  auto own = repeat(a, scene, engine, replay, folder);
  if (!own) return own.error();
  const core::Status compared = replay.capability == "broad"    ? compare_pairs(a, own.value(), replay)
                                : replay.capability == "narrow" ? compare_separations(a, own.value(), replay)
                                                                : compare_simulations(a, own.value(), replay);
  if (!compared) return compared.error();
  return replay;
}

}  // namespace broadside::bench
