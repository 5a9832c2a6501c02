#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "bench/build_facts.hpp"
#include "bench/campaign/manifest.hpp"
#include "bench/campaign/merge.hpp"
#include "bench/campaign/run_cells.hpp"
#include "bench/cell/more_than_zero.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/cli/commands.hpp"
#include "bench/contest/cell_seconds.hpp"
#include "bench/contest/contest_document.hpp"
#include "bench/contest/missing_engines.hpp"
#include "bench/fetched/fetched_engines.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/record/run_plan.hpp"

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;
using contest::ContestRequest;

struct ContestArguments {
  ContestRequest request;
  std::string out = "out/contest";
  std::uint32_t jobs = 1;  // cells at a time
  bool only_reports = false;
  bool only_plans = false;
  bool installs = false;
};

std::string command_of(const ContestArguments& a) {
  std::string text = "broadside contest";
  for (const std::string& engine : a.request.engines) text += " --engine '" + engine + "'";
  for (const std::string& scene : a.request.scenes) text += " --scene '" + scene + "'";
  if (a.request.has_largest_heaps) text += " --heaps";
  if (a.jobs > 1) text += fmt::format(" --jobs {}", a.jobs);
  return text + fmt::format(" --repetitions {} --out {}", a.request.repetitions, a.out);
}

// Writes the manifest. Finished cells stay in the folder, so those that an earlier plan had too are not run again.
core::Status plan_into(const fs::path& folder, const ContestRequest& request) {
  auto campaign = contest::contest_campaign(request);
  if (!campaign) return campaign.error();
  if (campaign.value().cells.empty())
    return core::Error{"none of these engines is on this machine", "--engine", "broadside list engines",
                       core::Exit::kMissing};
  auto manifest = campaign::make_manifest(campaign.value());
  if (!manifest) return manifest.error();
  return campaign::write_manifest(folder, manifest.value());
}

void show_progress(std::size_t done, std::size_t all, double left, const campaign::GroupEnd& end) {
  const auto& work = end.cells.front().work;
  const std::string line = fmt::format("{} of {}, about {:.0f} min left: {} on {} {}", done, all, left / 60.0,
                                       work.engine, work.scene, end.word);
  if (isatty(STDERR_FILENO) != 0)
    fmt::print(stderr, "\r\033[K{}", line);
  else if (done % 25 == 0 || done == all)
    fmt::print(stderr, "{}\n", line);
}

core::Result<std::map<std::string, double>> own_steps(const ContestRequest& request) {
  auto scenes = contest::scenes_of(request);
  if (!scenes) return scenes.error();
  std::map<std::string, double> steps;
  for (const std::string& name : scenes.value()) {
    auto scene = SceneArguments{name, 0, false}.make();
    if (!scene) return scene.error();
    steps[name] = static_cast<double>(scene.value().dt_s);
  }
  return steps;
}

core::Exit exit_of_contest(const contest::ContestTable& table, std::uint32_t missing) {
  for (const contest::SceneTable& scene : table.scenes)
    for (const auto& [label, steps] : scene.entries)
      for (const auto& [step, entry] : steps)
        if (step.empty() && !entry.broken.empty()) return core::Exit::kFailed;
  return missing > 0 ? core::Exit::kMissing : core::Exit::kGood;
}

bool ask_terminal(const std::string& question) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return false;
  fmt::print(stderr, "{} [y/N] ", question);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

// How packages of npm are installed: by fetch_engine. With `yes` every question is answered with yes.
contest::InstallPath npm_path(bool yes) {
  contest::InstallPath path;
  for (const core::EngineRow& row : fetched_engine_rows()) path.ids.emplace_back(row.id);
  path.agrees = [yes](const std::string& question) { return yes || ask_terminal(question); };
  path.install = [](std::string_view id) {
    return fetch_engine(id, [id](std::string_view step) { fmt::print(stderr, "{}: {}\n", id, step); });
  };
  return path;
}

// Runs the missing cells, and writes beside the cells how long each took.
core::Status run_cells_of(const ContestArguments& a, const campaign::Manifest& manifest) {
  const fs::path folder = a.out;
  auto taken = contest::CellSeconds::read(folder);
  if (!taken) return taken.error();
  const contest::CellSeconds kept = contest::CellSeconds::kept();
  contest::Forecast forecast(kept, manifest, folder);
  std::size_t done = 0;
  const auto tell = [&](const campaign::GroupEnd& end) {
    done += end.cells.size();
    const campaign::CellWork& work = end.cells.front().work;
    forecast.finish(work, end.seconds);
    taken.value().set(work.scene, work.engine, end.seconds);
    show_progress(done, manifest.cells.size(), forecast.left_s(a.jobs), end);
  };
  auto tally = campaign::run_cells(folder, {}, tell, a.jobs);
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\n");
  if (!tally) return tally.error();
  return taken.value().write(folder, fmt::format("{}; {} cells at a time", machine_line(), a.jobs));
}

// Prints the cells and how long they would take; makes no folder.
core::Exit show_plan(const ContestArguments& a) {
  auto campaign = contest::contest_campaign(a.request);
  if (!campaign) return complain(campaign.error());
  auto manifest = campaign::make_manifest(campaign.value());
  if (!manifest) return complain(manifest.error());
  fmt::print("{}", contest::plan_text(contest::CellSeconds::kept(), manifest.value(), a.jobs));
  return core::Exit::kGood;
}

core::Exit run_contest(const ContestArguments& a) {
  if (a.only_plans) return show_plan(a);
  const fs::path folder = a.out;
  if (core::Status s = prepare_folder(folder); !s) return complain(s.error());
  auto entrants = contest::entrants_of(a.request);
  if (!entrants) return complain(entrants.error());
  if (!a.only_reports && contest::install_missing(entrants.value(), npm_path(a.installs)) > 0) {
    entrants = contest::entrants_of(a.request);
    if (!entrants) return complain(entrants.error());
  }
  for (const contest::Entrant& e : entrants.value())
    if (!a.only_reports && !e.absent.empty()) fmt::print("{}: {}\n", e.engine, e.absent);
  // With only_reports the cells may come from another machine or another build, so the page is made from the manifest
  // with which they were run.
  if (!a.only_reports || !fs::exists(folder / "manifest.json"))
    if (core::Status s = plan_into(folder, a.request); !s) return complain(s.error());
  auto manifest = campaign::read_manifest(folder);
  if (!manifest) return complain(manifest.error());
  if (!a.only_reports)
    if (core::Status s = run_cells_of(a, manifest.value()); !s) return complain(s.error());
  auto merged = campaign::merge_cells(folder, folder);
  if (!merged) return complain(merged.error());
  auto rows = core::read_rows(folder);
  if (!rows) return complain(rows.error());
  auto steps = own_steps(a.request);
  if (!steps) return complain(steps.error());
  contest::ContestTable table = contest::contest_table(rows.value(), entrants.value(), steps.value());
  table.cells_at_once = a.jobs;
  auto with_energy = contest::scenes_with_energy(a.request);
  if (!with_energy) return complain(with_energy.error());
  if (core::Status s = contest::read_energy(table, folder, with_energy.value()); !s) return complain(s.error());
  const Document document = contest::contest_document(table, command_of(a));
  if (core::Status s = write_document(document, folder, "contest"); !s) return complain(s.error());
  fmt::print("{}\n\nReport: {}\n", document.lead, (folder / "contest.html").string());
  if (is_interrupted())
    return complain({"interrupted: finished cells are kept, and the page shows them", folder.string(),
                     "call it again to continue", core::Exit::kMissing});
  return exit_of_contest(table, merged.value().missing);
}

}  // namespace

void add_contest(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ContestArguments>();
  CLI::App* command = program.add_subcommand(
      "contest",
      "Run every engine of rigid bodies on every scene with a known answer, and compare verdicts, errors and costs");
  command->add_option("--engine,--engines", a->request.engines,
                      "Engines, such as ode-world[solver=dantzig] (default: all)");
  command->add_option("--scene,--scenes", a->request.scenes,
                      "Scenes, or beginnings of names: rigid:incline:* (default: all rigid:*)");
  command
      ->add_option(
          "--steps", a->request.step_factors,
          "Steps, as multiples of each scene's own step; the matrix shows 1. Without --scenes, one scene of each kind "
          "runs at all of them")
      ->delimiter(',')
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_option("--repetitions", a->request.repetitions, "Timed runs of a cell; 0 = verdicts alone")
      ->capture_default_str();
  command->add_option("--time-limit", a->request.time_limit_s, "Seconds that each part of a cell may take")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command
      ->add_option(
          "--jobs", a->jobs,
          "Cells to run at a time; with more than one, times are those of a busy machine, and the page says so")
      ->check(CLI::Range(1U, 1024U))
      ->capture_default_str();
  command->add_flag("--heaps", a->request.has_largest_heaps,
                    "Also run a heap of 10,000 boxes: an hour more on two cores");
  command->add_flag("--yes", a->installs,
                    "Install missing engines from npm without asking; without a terminal, nothing is asked");
  command->add_flag("--dry-run", a->only_plans,
                    "Run nothing: print how many cells there are, how long they take, and the most expensive ones");
  command->add_flag("--only-report", a->only_reports, "Run nothing: make the page from the cells that exist");
  command->add_option("--out", a->out, "Folder for cells and page; a second call continues there")
      ->capture_default_str();
  command->footer(
      "Each cell runs in a child process and is kept when it is finished, as in a campaign "
      "(bench/campaign/README.md).\n"
      "Exit codes: 0 every law holds at the scenes' own steps; 1 one is broken; 3 a cell is missing.");
  command->callback([a, &exit] { exit = run_contest(*a); });
}

}  // namespace broadside::bench
