#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/main_job.hpp"
#include "reports/report.hpp"
#include "reports/terminal_table.hpp"

namespace broadside::bench {
namespace {

// Prints the cells of each scene under the scene's name.
void print_cells(const std::vector<core::Cell>& cells) {
  for (auto begin = cells.begin(); begin != cells.end();) {
    const auto end = std::find_if(
        begin, cells.end(), [&](const core::Cell& c) { return c.stamp.scene_digest != begin->stamp.scene_digest; });
    fmt::print("{}\n{}\n", begin->stamp.scene_name, reports::cell_table({begin, end}));
    begin = end;
  }
}

core::Exit demo(const MainJob& job) {
  auto done = run_main_job(job);
  if (!done) return complain(done.error());
  const MainJobRows& rows = done.value();
  print_cells(rows.all.cells);
  fmt::print("{}", reports::verdict_table(rows.all.verdicts));
  const std::string failures = reports::failure_lines(rows.deciding.verdicts);
  if (!failures.empty()) fmt::print("\n{}", failures);
  const std::string of_others = reports::failure_lines(rows.others.verdicts);
  if (!of_others.empty())
    fmt::print("\nEngines made by others on {}; these lines do not decide the exit code:\n{}", job.turning.spec,
               of_others);
  fmt::print("\nReport: {}\n", (job.folder / (reports::has_html_page() ? "report.html" : "report.md")).string());
  return exit_of(rows);
}

}  // namespace

void add_demo(CLI::App& program, core::Exit& exit) {
  auto job = std::make_shared<MainJob>();
  auto folder = std::make_shared<std::string>("out/demo");
  CLI::App* command = program.add_subcommand(
      "demo",
      "The main job: fifty bunnies fall, then twelve bricks that turn; every engine is recorded, judged, timed and "
      "reported");
  command->footer(
      "Exit codes: 0 good; 1 a law is broken on the first scene, or on the turning scene by an engine of Broadside's "
      "own;\n3 one of these is inconclusive or missing, though this machine can run it. Engines made by others (those "
      "that run\nin a child process) are compared on the turning scene: what they break is on the page and in the "
      "terminal, and does\nnot decide.");
  command->add_option("--out", *folder, "Folder for traces and reports")->capture_default_str();
  command->add_option("--scene", job->scene.spec, "Another first scene")->capture_default_str();
  command
      ->add_option("--turning-scene", job->turning.spec,
                   "Another scene for engines of rigid bodies; its traces go to the subfolder turning")
      ->capture_default_str();
  command->add_option("--frames", job->scene.frames, "Frames to simulate of both scenes (default: their own)")
      ->check(more_than_zero, "POSITIVE");
  command->add_option("--repetitions", job->repetitions, "Timed runs of each engine")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->callback([job, folder, &exit] {
    job->folder = *folder;
    job->turning.frames = job->scene.frames;
    exit = demo(*job);
  });
}

}  // namespace broadside::bench
