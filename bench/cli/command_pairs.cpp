#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/limit_arguments.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/timing/box_race.hpp"
#include "datasets/box_streams/box_stream.hpp"

namespace broadside::bench {
namespace {

// Each part reads all boxes once, so there are at most this many.
constexpr std::uint32_t kMostParts = 4096;

struct PairsArguments {
  std::string boxes;
  EngineArguments engines;
  std::uint32_t frames = 0;
  std::uint32_t parts = 1;
  bool only_digest = false;
  bool as_json = false;
  ChildLimits limits;
  bool is_in_process = false;
};

void print_table(const std::vector<RaceRow>& rows) {
  fmt::print("{:<28} {:>12} {:>12} {:>18} {:>12} {:>12} {:>12} {:>12}\n", "engine", "pairs", "raw pairs", "digest",
             "update ms", "find ms", "filter ms", "read back ms");
  for (const RaceRow& r : rows) {
    if (!r.absent.empty())
      fmt::print("{:<28} {}: {}\n{:<28} repeat: {}\n", r.label, r.verdict, r.absent, "", r.repeat);
    else
      fmt::print("{:<28} {:>12} {:>12} {:#018x} {:>12.3f} {:>12.3f} {:>12.3f} {:>12.3f}\n", r.label, r.pairs, r.raw,
                 r.digest, r.update_s * 1e3, r.find_s * 1e3, r.filter_s * 1e3, r.read_back_s * 1e3);
  }
  for (const RaceRow& r : rows)
    if (!r.path.empty()) fmt::print("{}: {}\n", r.label, r.path);
  for (const RaceRow& r : rows) {
    if (r.parts <= 1 || !r.absent.empty()) continue;
    const auto given = static_cast<double>(r.boxes * r.frames);
    const double more = given == 0.0 ? 0.0 : 100.0 * (static_cast<double>(r.dealt) / given - 1.0);
    fmt::print("{}: {} parts with {:.3g} % more boxes, cut in {:.3f} ms of the update; at most {} pairs at once\n",
               r.label, r.parts, more, r.cut_s * 1e3, r.most_pairs_at_once);
  }
  // All engines had the same boxes.
  for (const RaceRow& r : rows) {
    if (!r.absent.empty()) continue;
    const double all = std::max(1.0, static_cast<double>(r.boxes) * static_cast<double>(r.frames));
    fmt::print("set: {}\n", datasets::words_of(r.kind, static_cast<double>(r.pairs) / all));
    if (!r.remark.empty()) fmt::print("{}\n", r.remark);
    break;
  }
}

// The engines that answered must agree. Exit code 3 when an engine did not answer.
core::Exit verdict_of(const std::vector<RaceRow>& rows) {
  const RaceRow* first = nullptr;
  core::Exit exit = core::Exit::kGood;
  for (const RaceRow& r : rows) {
    if (!r.absent.empty()) {
      exit = core::Exit::kMissing;
      continue;
    }
    if (first == nullptr) first = &r;
    if (r.digest == first->digest) continue;
    fmt::print(stderr, "broadside: {} and {} found different pairs\n", first->label, r.label);
    return core::Exit::kFailed;
  }
  return exit;
}

core::Exit pairs(const PairsArguments& a) {
  if (a.is_in_process) limit_this_process(a.limits.memory_mib);
  if (core::Status s = datasets::check_boxes_name(a.boxes); !s) return complain(s.error());
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  auto rows = race_boxes(a.boxes, cells.value(), a.frames, a.parts, a.limits, a.is_in_process);
  if (!rows) return complain(rows.error());
  if (a.as_json) {
    fmt::print("{}\n", race_json(rows.value()));
  } else if (a.only_digest) {
    for (const RaceRow& r : rows.value())
      if (r.absent.empty()) fmt::print("{:#018x} {}\n", r.digest, r.label);
  } else {
    print_table(rows.value());
  }
  return verdict_of(rows.value());
}

}  // namespace

void add_pairs(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<PairsArguments>();
  CLI::App* command = program.add_subcommand(
      "pairs",
      "Find overlapping pairs of boxes; engines must agree (exit 1 if they do not); times are of this one call. "
      "Prints what kind of set the boxes are, and which algorithm was used by an engine that has several");
  command
      ->add_option(
          "BOXES", a->boxes,
          "boxes:uniform:N and the like (broadside list scenes), a raw .boxes file, an .h5 box stream, or a trace")
      ->required();
  a->engines.add_to(*command);
  command->add_option("--frames", a->frames, "Frames of a moving stream (default: all)")
      ->check(more_than_zero, "POSITIVE");
  command
      ->add_option(
          "--parts", a->parts,
          "Cut space into this many ranges and search one after another, so that neither all boxes nor all pairs are "
          "in the engine at once")
      ->check(CLI::Range(1U, kMostParts));
  command->add_flag("--digest", a->only_digest, "Print only digest and engine");
  command->add_flag("--json", a->as_json, "As JSON");
  add_limits(*command, a->limits);
  command->add_flag("--in-process", a->is_in_process, "Run references in this process")->group("");
  command->callback([a, &exit] { exit = pairs(*a); });
}

}  // namespace broadside::bench
