#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/limit_arguments.hpp"
#include "bench/converge/convergence.hpp"
#include "bench/process/scratch_folder.hpp"
#include "bench/record/run_plan.hpp"
#include "core/whole_file.hpp"
#include "datasets/scene_file/scene_file.hpp"
#include "validation/mechanics/scene_answer.hpp"

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr int kStepSizes = 3;  // h, h/2, h/4

struct ConvergeArguments {
  SceneArguments scene;
  EngineArguments engines;
  ChildLimits limits;
  std::string json;
};

// Runs the engine over the scene at a part of its step, and returns the trace. The scene is passed in a file, so that
// an engine that runs in a child process gets the same one.
core::Result<fs::path> recorded_part(const core::Scene& whole, int part, const CellSpec& spec,
                                     const ChildLimits& limits, const fs::path& folder) {
  core::Scene scene = whole;
  scene.dt_s = std::ldexp(whole.dt_s, -part);
  scene.frames = whole.frames << static_cast<unsigned>(part);
  if (scene.frames >> static_cast<unsigned>(part) != whole.frames)
    return core::Error{"the scene has too many frames to halve its step", scene.name, "give fewer with --frames"};
  const fs::path own = folder / ("h" + std::to_string(1 << part));
  if (core::Status s = prepare_folder(own); !s) return s.error();
  const fs::path file = own / "scene.toml";
  if (core::Status s = datasets::write_scene_file(scene, file); !s) return s.error();
  RunPlan plan;
  plan.source.spec = file.string();
  auto read = plan.source.make();
  if (!read) return read.error();
  plan.scene = std::move(read).value();
  plan.cells = {spec};
  plan.frames = plan.scene.frames;
  auto selection = StepSelection::parse(1, {});
  if (!selection) return selection.error();
  plan.selection = std::move(selection).value();
  plan.folder = own;
  plan.limits = limits;
  auto outcome = run_plan(plan);
  if (!outcome) return outcome.error();
  const core::Cell& cell = outcome.value().cells.back();
  if (cell.state != core::CellState::kRecorded)
    return core::Error{"the engine did not record the scene: " + cell.reason,
                       whole.name + " at " + fmt::format("{:g} s", scene.dt_s), "see 'broadside run' on the same scene",
                       core::Exit::kMissing};
  return own / cell.trace_file;
}

OrderedJson convergence_json(const Convergence& c, const core::Verdict& v, const core::Scene& scene,
                             const std::string& engine) {
  OrderedJson figures = OrderedJson::array();
  for (const FigureErrors& f : c.figures) {
    OrderedJson orders = OrderedJson::array();
    for (std::size_t k = 1; k < f.error.size(); ++k) {
      const double order = observed_order(f, k);
      orders.push_back(std::isfinite(order) ? OrderedJson(order) : OrderedJson(nullptr));
    }
    figures.push_back({{"what", f.what},
                       {"unit", f.unit},
                       {"errors", f.error},
                       {"limits", f.limit},
                       {"floor", f.floor},
                       {"has_order", f.has_order},
                       {"observed_orders", orders}});
  }
  return {{"scene", scene.name},
          {"answer", scene.answer},
          {"engine", engine},
          {"declared_order", c.declared_order},
          {"dt_s", c.dt_s},
          {"figures", figures},
          {"outcome", core::outcome_word(v.outcome)},
          {"explanation", v.explanation},
          {"origin", v.origin}};
}

void print_convergence(const Convergence& c) {
  fmt::print("{:<34}", "largest error at h =");
  for (const double dt : c.dt_s) fmt::print(" {:>12}", fmt::format("{:.4g} s", dt));
  fmt::print("  orders\n");
  for (const FigureErrors& f : c.figures) {
    fmt::print("{:<34}", f.what + (f.unit.empty() ? "" : ", " + f.unit));
    for (const double e : f.error) fmt::print(" {:>12.4g}", e);
    for (std::size_t k = 1; k < f.error.size(); ++k) {
      const double order = observed_order(f, k);
      fmt::print("  {}", std::isfinite(order) ? fmt::format("{:.2f}", order) : std::string("-"));
    }
    fmt::print("{}\n", f.has_order ? "" : "  (none is defined)");
  }
}

core::Exit exit_of_convergence(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return core::Exit::kGood;
    case core::Outcome::kFail:
      return core::Exit::kFailed;
    default:
      return core::Exit::kMissing;
  }
}

core::Exit converge(const ConvergeArguments& a) {
  auto scene = a.scene.make();
  if (!scene) return complain(scene.error());
  const validation::SceneAnswer* answer = validation::find_answer(scene.value().answer);
  if (answer == nullptr)
    return complain({scene.value().answer.empty()
                         ? std::string("the scene has no exact answer")
                         : "the scene's answer '" + scene.value().answer + "' is not one that is known here",
                     scene.value().name, "'broadside list scenes' shows those of rigid:*"});
  auto cells = a.engines.make();
  if (!cells) return complain(cells.error());
  if (cells.value().size() != 1)
    return complain({"converge runs one engine", "--engine", "name one, and repeat the command for others"});
  const CellSpec& spec = cells.value().front();
  const ScratchFolder scratch;
  std::vector<fs::path> traces;
  for (int part = 0; part < kStepSizes; ++part) {
    auto trace = recorded_part(scene.value(), part, spec, a.limits, scratch.path());
    if (!trace) return complain(trace.error());
    traces.push_back(trace.value());
  }
  const auto measured = measure_convergence(traces);
  if (!measured) return complain(measured.error());
  const core::Verdict verdict = judge_convergence(measured.value());
  const std::string engine = label_of(spec);
  print_convergence(measured.value());
  fmt::print("converge: {} of {} on {}: {}\n", core::outcome_word(verdict.outcome), engine, scene.value().name,
             verdict.explanation);
  if (!a.json.empty()) {
    const OrderedJson json = convergence_json(measured.value(), verdict, scene.value(), engine);
    if (core::Status s = core::write_whole_file(a.json, json.dump(2) + "\n"); !s) return complain(s.error());
  }
  return exit_of_convergence(verdict.outcome);
}

}  // namespace

void add_converge(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ConvergeArguments>();
  CLI::App* command = program.add_subcommand(
      "converge",
      "Measure an engine's errors against a scene's exact answer at h, h/2 and h/4, and the order of convergence");
  a->scene.add_to(*command);
  a->engines.add_to(*command);
  command->add_option("--json", a->json, "Write the errors and the verdict here");
  add_limits(*command, a->limits);
  command->callback([a, &exit] { exit = converge(*a); });
}

}  // namespace broadside::bench
