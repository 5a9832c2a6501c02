#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/box_race.hpp"
#include "bench/commands.hpp"
#include "bench/scene_arguments.hpp"

namespace broadside::bench {
namespace {

struct PairsArguments {
  std::string boxes;
  EngineArguments engines;
  std::uint32_t frames = 0;
  bool only_digest = false;
  bool as_json = false;
};

void print_table(const std::vector<RaceRow>& rows) {
  fmt::print("{:<28} {:>12} {:>18} {:>12} {:>12} {:>12}\n", "engine", "pairs", "digest", "update ms", "find ms",
             "read back ms");
  for (const RaceRow& r : rows)
    fmt::print("{:<28} {:>12} {:#018x} {:>12.3f} {:>12.3f} {:>12.3f}\n", r.label, r.pairs, r.digest, r.update_s * 1e3,
               r.find_s * 1e3, r.read_back_s * 1e3);
}

void print_json(const std::vector<RaceRow>& rows) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const RaceRow& r : rows)
    out.push_back({{"engine", r.label},
                   {"frames", r.frames},
                   {"boxes", r.boxes},
                   {"pairs", r.pairs},
                   {"raw_pairs", r.raw},
                   {"digest", fmt::format("{:#018x}", r.digest)},
                   {"update_s", r.update_s},
                   {"find_s", r.find_s},
                   {"read_back_s", r.read_back_s}});
  fmt::print("{}\n", out.dump(2));
}

core::Exit pairs(const PairsArguments& a) {
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  auto rows = race_boxes(a.boxes, cells.value(), a.frames);
  if (!rows) return complain(rows.error());
  if (a.as_json)
    print_json(rows.value());
  else if (a.only_digest)
    for (const RaceRow& r : rows.value()) fmt::print("{:#018x} {}\n", r.digest, r.label);
  else
    print_table(rows.value());
  for (const RaceRow& r : rows.value()) {
    if (r.digest == rows.value().front().digest) continue;
    fmt::print(stderr, "broadside: {} and {} found different pairs\n", rows.value().front().label, r.label);
    return core::Exit::kFailed;
  }
  return core::Exit::kGood;
}

}  // namespace

void add_pairs(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<PairsArguments>();
  CLI::App* command = program.add_subcommand(
      "pairs", "Overlapping pairs of boxes: engines must agree (exit 1 if they do not); times are of this one call");
  command
      ->add_option(
          "BOXES", a->boxes,
          "boxes:uniform:N and the like (broadside list scenes), a raw .boxes file, an .h5 box stream, or a trace")
      ->required();
  a->engines.add_to(*command);
  command->add_option("--frames", a->frames, "Frames of a moving stream (default: all)")->check(CLI::PositiveNumber);
  command->add_flag("--digest", a->only_digest, "Print only digest and engine");
  command->add_flag("--json", a->as_json, "As JSON");
  command->callback([a, &exit] { exit = pairs(*a); });
}

}  // namespace broadside::bench
