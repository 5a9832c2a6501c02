#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/bisect/bisection.hpp"
#include "bench/bisect/folder_lock.hpp"
#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/commands.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

struct BisectArguments {
  bisect::BuildsRequest builds;
  bisect::Question question;
  std::vector<std::string> on;
  std::string folder = "out/bisect";
  bool as_json = false;
};

// The command for a scene: the program of each build runs it and checks the traces.
std::string command_of(const bisect::TimedWork& work) {
  std::string run = "{program} run " + bisect::quoted(work.scene);
  for (const std::string& engine : work.engines) run += " --engine " + bisect::quoted(engine);
  if (work.frames > 0) run += " --frames " + std::to_string(work.frames);
  if (work.allow_stand_in) run += " --stand-in";
  return run +
         " --out {out}; code=$?; [ $code -eq 0 ] || [ $code -eq 3 ] || exit $code; "
         "{program} check {out}/*.h5 --json {out}/verdicts.json";
}

core::Status complete(BisectArguments& a) {
  bisect::Question& question = a.question;
  const bool has_scene = !question.work.scene.empty();
  if (has_scene == !question.command.empty())
    return core::Error{has_scene ? "--command and --scene were both given" : "there is nothing to run", "bisect",
                       "give --command 'COMMAND' with {build} or {program} in it, or --scene SCENE"};
  if (has_scene && question.work.engines.empty()) question.work.engines = {"octree-cpu"};
  if (has_scene) question.command = command_of(question.work);
  question.work.command = question.command;
  if (question.command.find("{build}") == std::string::npos && question.command.find("{program}") == std::string::npos)
    return core::Error{"it names no build, so every build would run the same", "--command",
                       "write {build} or {program} where the build's file or folder belongs, and {out} for results"};
  if (!a.builds.command.empty() && !a.builds.between.empty())
    return core::Error{"--build and --between were both given", "bisect",
                       "--build makes every commit from GOOD to BAD; --between lists builds that exist"};
  if (question.times.most < question.times.processes) question.times.most = question.times.processes;
  for (const bisect::QuantityWord& row : bisect::kQuantityWords)
    if (std::find(a.on.begin(), a.on.end(), row.word) != a.on.end()) question.quantities.push_back(row.quantity);
  if (!a.builds.command.empty()) question.made_by = a.builds.command + "\n" + a.builds.program;
  a.builds.folder = question.folder = a.folder;
  return core::Done{};
}

core::Exit find(BisectArguments& a) {
  if (core::Status s = complete(a); !s) return complain(s.error());
  auto lock = bisect::FolderLock::take(a.folder);
  if (!lock) return complain(lock.error());
  a.builds.lock = a.question.work.lock = lock.value().descriptor();
  auto builds = a.builds.command.empty() ? bisect::given_builds(a.builds) : bisect::commit_builds(a.builds);
  if (!builds) return complain(builds.error());
  const auto found = bisect::bisect(*builds.value(), a.question);
  if (!found) return complain(found.error());
  const bisect::Builds& all = *builds.value();
  if (core::Status s = core::write_whole_file(a.question.folder / "bisect.md",
                                              bisect::bisection_markdown(all, a.question, found.value()));
      !s)
    return complain(s.error());
  fmt::print("{}", a.as_json ? bisect::bisection_json(all, a.question, found.value())
                             : bisect::bisection_text(all, a.question, found.value()));
  return found.value().exit();
}

void add_work(CLI::App& command, BisectArguments& a) {
  bisect::Question& question = a.question;
  command.add_option(
      "--command", question.command,
      "The shell command to run on each build. {build}: its file or folder; {program}: the Broadside program in it; "
      "{out}: the folder for its results");
  command.add_option("--scene", question.work.scene,
                     "Instead of --command: the program of each build runs and checks this scene");
  command
      .add_option("--engine", question.work.engines, "With --scene: an engine (default octree-cpu); may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--frames", question.work.frames, "With --scene: frames (default: the scene's own)")
      ->check(more_than_zero, "POSITIVE");
  command.add_flag("--stand-in", question.work.allow_stand_in, "With --scene: as in run");
}

void add_builds(CLI::App& command, BisectArguments& a) {
  command.add_option("GOOD", a.builds.good, "The good build: a file or folder; with --build a commit")->required();
  command.add_option("BAD", a.builds.bad, "The bad build, likewise")->required();
  command.add_option("--between", a.builds.between, "Builds between these two, oldest first");
  command.add_option("--build", a.builds.command,
                     "GOOD and BAD are commits; this builds one, in the root of a clone of its own. A commit that does "
                     "not build is skipped");
  command.add_option("--repository", a.builds.repository, "With --build: the git repository")->capture_default_str();
  command.add_option("--program", a.builds.program,
                     "Where a build is a folder: the program in it, such as build/release/bench/broadside");
}

void add_gate(CLI::App& command, BisectArguments& a) {
  std::vector<std::string> words;
  words.reserve(std::size(bisect::kQuantityWords));
  for (const bisect::QuantityWord& row : bisect::kQuantityWords) words.emplace_back(row.word);
  a.on = {"verdict", "contacts", "digest", "counter"};
  command
      .add_option("--on", a.on,
                  "What may change: verdict contacts digest counter time exit. Each has a search of its own")
      ->check(CLI::IsMember(words))
      ->delimiter(',')
      ->capture_default_str();
  bisect::TimeSettings& times = a.question.times;
  command.add_option("--delta", times.delta, "With --on time: smallest change that counts, as in compare")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command.add_option("--processes", times.processes, "With --on time: timed processes of each build")
      ->check(CLI::Range(6, 100'000))
      ->capture_default_str();
  command
      .add_option("--most-processes", times.most, "With --on time: up to this many where the first ones do not decide")
      ->check(CLI::Range(6, 100'000))
      ->capture_default_str();
}

}  // namespace

void add_bisect(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<BisectArguments>();
  CLI::App* command = program.add_subcommand(
      "bisect", "Find the first build that changes a verdict, contacts, a digest, a counter or a time");
  add_builds(*command, *a);
  add_work(*command, *a);
  add_gate(*command, *a);
  command
      ->add_option("--out", a->folder,
                   "Folder for the results of each build, the state, and bisect.md; the same call continues there")
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print JSON");
  command->footer(
      "The command leaves cells.json and verdicts.json in {out} (run --out {out}, check --json {out}/verdicts.json);\n"
      "for --on time samples.json too. Where it exits 125, 126 or 127 the build is skipped. Exit codes: 0 no change;\n"
      "1 the first change was found; 2 bad input; 3 undecided, because builds do not compile or GOOD differs\n"
      "from itself. A command that may hang: 'timeout 600 ...'. Example, with commits of a library that is an engine:\n"
      "  broadside bisect v1.2 main --build 'make libmine.so' --command 'broadside run two-body:glancing\n"
      "    --engine {build}/libmine.so --out {out} && broadside check {out}/*.h5 --json {out}/verdicts.json'");
  command->callback([a, &exit] { exit = find(*a); });
}

}  // namespace broadside::bench
