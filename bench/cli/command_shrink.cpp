#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cell/trace_scene.hpp"
#include "bench/cli/commands.hpp"
#include "bench/shrink/case_text.hpp"
#include "bench/shrink/shrink_boxes.hpp"
#include "bench/shrink/shrink_scene.hpp"
#include "bench/shrink/trace_start.hpp"
#include "bench/shrink/trial.hpp"
#include "core/whole_file.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/raw_boxes.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace broadside::bench {
namespace {

struct ShrinkArguments {
  SceneArguments scene;
  EngineArguments engines;
  std::string validator;
  std::string against;
  std::string out = "shrunk";
  double time_limit_s = 60.0;
};

ShrinkLimits limits_of(const ShrinkArguments& a) {
  return {a.time_limit_s, [](const std::string& line) { fmt::print(stderr, "shrink: {}\n", line); }};
}

std::string label(const CellSpec& spec) {
  std::string settings;
  for (const auto& [key, value] : spec.settings) settings += (settings.empty() ? "" : ",") + key + "=" + value;
  return std::string(spec.row->id) + (settings.empty() ? "" : "[" + settings + "]");
}

core::Result<CellSpec> one_engine(const ShrinkArguments& a) {
  auto cells = a.engines.make();
  if (!cells) return cells.error();
  if (cells.value().size() != 1)
    return core::Error{"more than one engine", "--engine", "shrink looks for the fault of one"};
  return std::move(cells.value().front());
}

// An HDF5 file can hold boxes alone or a trace; without a validator its boxes are used.
bool is_box_set(const ShrinkArguments& a) {
  const std::string& spec = a.scene.spec;
  return spec.starts_with("boxes:") || spec.ends_with(".boxes") || spec.ends_with(".bin") ||
         (is_trace_file(spec) && a.validator.empty());
}

core::Result<std::vector<core::Pair>> pairs_of(const CellSpec& spec, const std::vector<core::Box>& boxes) {
  auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
  if (!settings) return settings.error();
  auto engine = spec.row->create(settings.value());
  if (!engine) return engine.error();
  core::BroadPhase* broad = engine.value().broad_phase.get();
  if (broad == nullptr)
    return core::Error{"it offers no broad phase with these settings", std::string(spec.row->id),
                       "see 'broadside list engines'"};
  const std::vector<std::uint8_t> is_static(boxes.size());
  if (core::Status s = broad->load(boxes, is_static); !s) return s.error();
  if (core::Status s = broad->update(boxes); !s) return s.error();
  if (core::Status s = broad->find(); !s) return s.error();
  auto found = broad->read_back();
  if (!found) return found.error();
  return std::move(found.value().pairs);
}

core::Exit print_boxes(const ShrunkBoxes& shrunk, const std::filesystem::path& file) {
  fmt::print("{} boxes are left, in {}\n", shrunk.boxes.size(), file.string());
  for (const core::Box& b : shrunk.boxes)
    fmt::print("  {:.9g} {:.9g} {:.9g} to {:.9g} {:.9g} {:.9g}\n", b.min.x, b.min.y, b.min.z, b.max.x, b.max.y,
               b.max.z);
  for (const core::Pair p : shrunk.missed) fmt::print("missed: {} and {}\n", p.i, p.j);
  for (const core::Pair p : shrunk.extra) fmt::print("too many: {} and {}\n", p.i, p.j);
  fmt::print("{} runs in {:.1f} s{}\n", shrunk.trials, shrunk.seconds,
             shrunk.is_out_of_time ? "; time ran out, so a smaller case may exist" : "");
  return core::Exit::kGood;
}

core::Exit shrink_box_set(const ShrinkArguments& a, const CellSpec& engine) {
  auto made = datasets::make_box_stream(a.scene.spec);
  if (!made) return complain(made.error());
  datasets::BoxStream& stream = made.value();
  if (auto first = pairs_of(engine, {}); !first) return complain(first.error());
  const PairFinder find = [&engine](const std::vector<core::Box>& boxes) { return pairs_of(engine, boxes); };
  // In a moving stream the first frame is taken whose boxes alone show the fault.
  for (std::uint32_t k = 0; k < stream.frames; ++k) {
    if (k > 0)
      if (core::Status s = stream.advance(stream.boxes); !s) return complain(s.error());
    const auto shrunk = shrink_boxes(stream.boxes, find, limits_of(a));
    if (!shrunk && k + 1 == stream.frames) return complain(shrunk.error());
    if (!shrunk) continue;
    const std::filesystem::path file = a.out + ".boxes";
    if (core::Status s = datasets::write_raw_boxes(shrunk.value().boxes, file); !s) return complain(s.error());
    return print_boxes(shrunk.value(), file);
  }
  return core::Exit::kGood;
}

std::string command_of(const ShrinkArguments& a, const Question& q) {
  std::string text =
      fmt::format("broadside shrink {} --validator {} --engine '{}'", a.scene.spec, a.validator, label(q.engine));
  if (a.scene.frames > 0) text += fmt::format(" --frames {}", a.scene.frames);
  if (a.scene.allow_stand_in) text += " --stand-in";
  return text + (a.against.empty() ? "" : " --against '" + a.against + "'");
}

core::Exit write_case(const ShrinkArguments& a, const Question& q, const ShrunkScene& shrunk) {
  const std::string toml = a.out + ".toml";
  const std::string source = a.out + "_test.cpp";
  if (core::Status s = datasets::write_scene_file(shrunk.scene, toml); !s) return complain(s.error());
  const std::string text =
      case_text(shrunk.scene, {command_of(a, q), label(q.engine), a.validator, a.against, shrunk.verdict});
  if (core::Status s = core::write_whole_file(source, text); !s) return complain(s.error());
  std::size_t triangles = 0;
  for (const auto& mesh : shrunk.scene.meshes) triangles += mesh->triangles.size();
  fmt::print(
      "{} bodies, {} frames, {} triangles are left\n{}: {}\n{} (run it), {} (a GoogleTest case)\n{} runs in {:.1f} "
      "s{}\n",
      shrunk.scene.body_count(), shrunk.scene.frames, triangles, core::outcome_word(shrunk.verdict.outcome),
      shrunk.verdict.explanation, toml, source, shrunk.trials, shrunk.seconds,
      shrunk.is_out_of_time ? "; time ran out, so a smaller case may exist" : "");
  return core::Exit::kGood;
}

// --out is the beginning of the files' names. Where it is a folder, the files are put inside and get names of our own.
std::string beginning_of(const std::string& out) {
  std::error_code ignored;
  const bool is_folder = out.ends_with('/') || std::filesystem::is_directory(out, ignored);
  return is_folder ? (std::filesystem::path(out) / "shrunk").string() : out;
}

core::Exit shrink(const ShrinkArguments& a) {
  auto engine = one_engine(a);
  if (!engine) return complain(engine.error());
  if (is_box_set(a)) return shrink_box_set(a, engine.value());
  if (a.validator.empty())
    return complain({"no validator is named", "--validator", "name the one that fails (broadside list validators)"});
  Question question{a.validator, std::move(engine).value(), {}};
  if (!a.against.empty()) {
    auto other = parse_cell_spec(a.against);
    if (!other) return complain(other.error());
    question.against = std::move(other).value();
  }
  auto scene = a.scene.make();
  if (!scene) return complain(scene.error());
  const Oracle oracle = [&question](const core::Scene& s) { return ask(question, s); };
  core::Scene start = std::move(scene).value();
  if (is_trace_file(a.scene.spec)) {
    auto later = start_before_fault(a.scene.spec, question, oracle);
    if (!later) return complain(later.error());
    if (later.value()) start = std::move(*later.value());
  }
  const auto shrunk = shrink_scene(start, oracle, limits_of(a));
  if (!shrunk) return complain(shrunk.error());
  return write_case(a, question, shrunk.value());
}

}  // namespace

void add_shrink(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ShrinkArguments>();
  CLI::App* command = program.add_subcommand(
      "shrink", "Find the smallest scene (or box file) on which an engine still fails, and write a test case of it");
  a->scene.add_to(*command);
  a->engines.add_to(*command);
  command->add_option("--validator", a->validator, "The validator that fails (not for boxes: pairs are compared)");
  command->add_option("--against", a->against, "For validators that compare: the other engine (default: a second run)");
  command
      ->add_option("--out", a->out,
                   "Writes OUT.toml with its meshes and OUT_test.cpp, or OUT.boxes; into a folder: shrunk.toml ...")
      ->capture_default_str();
  command->add_option("--time-limit", a->time_limit_s, "Seconds after which the smallest case so far is taken")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->footer(
      "SCENE may also be a trace (.h5) or boxes (boxes:uniform:N, FILE.boxes). Exit codes: 0 a case was written;\n"
      "2 bad input, or the validator does not fail; 3 the engine is not on this machine.");
  command->callback([a, &exit] {
    a->out = beginning_of(a->out);
    exit = shrink(*a);
  });
}

}  // namespace broadside::bench
