#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/build_facts.hpp"
#include "bench/cell/more_than_zero.hpp"
#include "bench/cli/commands.hpp"
#include "bench/paper/campaign.hpp"
#include "bench/paper/paper_plan.hpp"
#include "bench/paper/sections.hpp"
#include "bench/record/run_plan.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

struct PaperArguments {
  paper::PaperRequest asked;
  std::string engine;
  std::string rows;
  std::string out = "out/paper";
};

std::string command_of(const PaperArguments& a) {
  std::string text = "broadside paper";
  for (const std::string& name : a.asked.experiments) text += " " + name;
  text += fmt::format(" --frames {} --runs {}", a.asked.plan.frames, a.asked.plan.runs);
  for (const std::string& model : a.asked.plan.models) text += " --models " + model;
  for (const std::uint32_t count : a.asked.plan.counts) text += fmt::format(" --counts {}", count);
  if (!a.engine.empty()) text += " --engine " + a.engine;
  return text;
}

bool asks_for(const PaperArguments& a, const std::string& name) {
  const auto rows = paper::experiments();
  const bool is_of_paper =
      std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row.id == name && row.is_of_paper; });
  return std::any_of(a.asked.experiments.begin(), a.asked.experiments.end(),
                     [&](const std::string& n) { return n == name || (n == "all" && is_of_paper); });
}

// The rows that belong to the experiments that were asked for.
std::vector<paper::PaperRow> shown(const PaperArguments& a, std::vector<paper::PaperRow> rows) {
  std::erase_if(rows, [&](const paper::PaperRow& row) {
    return std::none_of(row.experiments.begin(), row.experiments.end(),
                        [&](const std::string& experiment) { return asks_for(a, experiment); });
  });
  return rows;
}

core::Result<std::vector<paper::PaperRow>> rows_of(const PaperArguments& a, std::string& device_words) {
  if (!a.rows.empty()) {
    auto known = paper::read_paper_rows(a.rows);
    if (!known) return known.error();
    return shown(a, std::move(known).value());
  }
  auto device = paper::choose_device(a.engine);
  if (!device) return device.error();
  device_words = device.value().words;
  paper::PaperRequest request = a.asked;
  request.device = std::move(device).value();
  request.machine = machine_line();
  auto cells = paper::plan_cells(request.experiments, request.plan, request.device);
  if (!cells) return cells.error();
  if (cells.value().empty()) return std::vector<paper::PaperRow>{};
  fmt::print("{}\n", device_words);
  return paper::run_campaign(request, a.out);
}

// 1 a validator failed; 3 a cell is absent or its time does not count; else 0.
core::Exit exit_of_paper(const std::vector<paper::PaperRow>& rows) {
  core::Exit exit = core::Exit::kGood;
  for (const paper::PaperRow& row : rows) {
    if (row.failed > 0) return core::Exit::kFailed;
    if (!row.absence.empty() || !row.is_admitted) exit = core::Exit::kMissing;
  }
  return exit;
}

core::Exit run_paper(const PaperArguments& a) {
  const std::filesystem::path folder = a.out;
  if (core::Status s = prepare_folder(folder); !s) return complain(s.error());
  paper::PaperText text;
  auto rows = rows_of(a, text.device);
  if (!rows) return complain(rows.error());
  text.command = command_of(a);
  text.shows_models = asks_for(a, "figureA1");
  text.models = a.asked.plan.models;
  text.allow_stand_in = a.asked.allow_stand_in;
  const Document document = paper::paper_document(rows.value(), text);
  if (core::Status s = write_document(document, folder, "paper"); !s) return complain(s.error());
  const Table cells = paper::cell_table(rows.value());
  if (core::Status s = core::write_whole_file(folder / "cells.csv", csv_text(cells)); !s) return complain(s.error());
  if (core::Status s = paper::write_paper_rows(folder / "rows.json", rows.value()); !s) return complain(s.error());
  fmt::print("{}\n\nReport: {}\n", document.lead, (folder / "paper.html").string());
  return exit_of_paper(rows.value());
}

std::string list_of_experiments() {
  std::string text;
  for (const paper::ExperimentRow& row : paper::experiments()) text += fmt::format("{:10} {}\n", row.id, row.title);
  return text + fmt::format("{:10} those of the paper\n", "all");
}

}  // namespace

void add_paper(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<PaperArguments>();
  CLI::App* command = program.add_subcommand(
      "paper",
      "Repeat the paper's experiments, judged and timed, with our tables and figures beside the published ones");
  command->add_option("EXPERIMENT", a->asked.experiments, "What to repeat; see below")->required();
  command->add_option("--frames", a->asked.plan.frames, "Frames of each run")
      ->check(CLI::Range(1U, 1000000U))
      ->capture_default_str();
  command->add_option("--runs", a->asked.plan.runs, "Timed runs of each cell, alternating with the scene's other cells")
      ->check(CLI::Range(1U, 10000U))
      ->capture_default_str();
  command
      ->add_option("--models", a->asked.plan.models,
                   "Models out of bunny, armadillo, dragon, asian_dragon (default: all)")
      ->delimiter(',');
  command->add_option("--counts", a->asked.plan.counts, "Numbers of bodies instead of the paper's")
      ->delimiter(',')
      ->check(more_than_zero, "POSITIVE");
  command->add_option("--engine", a->engine, "octree-gpu or octree-cpu (default: the best that runs here)");
  command
      ->add_option("--limit", a->asked.plan.limit_s,
                   "Leave out cells of 'beyond' that are expected to take more seconds than this")
      ->check(more_than_zero, "POSITIVE")
      ->capture_default_str();
  command->add_flag("--stand-in", a->asked.allow_stand_in,
                    "Use a procedural body of the same size class where a mesh cannot be had; reports say so");
  command->add_flag("--keep-traces", a->asked.keeps_traces, "Keep the traces of finished cells in OUT/work");
  command->add_option("--rows", a->rows, "Measure nothing: make the report from this rows.json");
  command
      ->add_option("--out", a->out, "Folder for the report, its data and finished cells; a second call continues there")
      ->capture_default_str();
  command->footer(
      list_of_experiments() +
      "\nFinished cells are folders in OUT/cells, keyed by scene, engine, settings, build and machine: after\n"
      "an interrupt the same command does only what is missing.");
  command->callback([a, &exit] { exit = run_paper(*a); });
}

}  // namespace broadside::bench
