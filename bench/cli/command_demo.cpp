#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/commands.hpp"
#include "bench/cli/main_job.hpp"
#include "reports/report.hpp"
#include "reports/terminal_table.hpp"

namespace broadside::bench {
namespace {

core::Exit demo(const MainJob& job) {
  auto rows = run_main_job(job);
  if (!rows) return complain(rows.error());
  fmt::print("{}\n{}", reports::cell_table(rows.value().cells), reports::verdict_table(rows.value().verdicts));
  const std::string failures = reports::failure_lines(rows.value().verdicts);
  if (!failures.empty()) fmt::print("\n{}", failures);
  fmt::print("\nReport: {}\n", (job.folder / (reports::has_html_page() ? "report.html" : "report.md")).string());
  return exit_of(rows.value());
}

}  // namespace

void add_demo(CLI::App& program, core::Exit& exit) {
  auto job = std::make_shared<MainJob>();
  auto folder = std::make_shared<std::string>("out/demo");
  CLI::App* command = program.add_subcommand(
      "demo", "The main job: fifty bunnies fall; every engine is recorded, judged, timed and reported");
  command->add_option("--out", *folder, "Folder for traces and reports")->capture_default_str();
  command->add_option("--scene", job->scene.spec, "Another scene")->capture_default_str();
  command->add_option("--frames", job->scene.frames, "Frames to simulate (default: the scene's own)")
      ->check(more_than_zero, "POSITIVE");
  command->add_option("--repetitions", job->repetitions, "Timed runs of each engine")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->callback([job, folder, &exit] {
    job->folder = *folder;
    exit = demo(*job);
  });
}

}  // namespace broadside::bench
