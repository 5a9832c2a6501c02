#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.hpp"
#include "core/rows.hpp"
#include "reports/history.hpp"

namespace broadside::bench {
namespace {

struct HistoryArguments {
  std::string file;
  std::vector<std::string> folders;
  std::string at;
  std::string scene;
  std::string engine;
  bool as_json = false;
};

std::string now_utc() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

core::Exit append(const HistoryArguments& a) {
  for (const std::string& folder : a.folders) {
    if (!std::filesystem::is_directory(folder))
      return complain({"no such folder", folder, "name a folder that run, check and time wrote into"});
    auto rows = core::read_rows(folder);
    if (!rows) return complain(rows.error());
    auto appended = reports::append_to_history(a.file, rows.value(), a.at.empty() ? now_utc() : a.at);
    if (!appended) return complain(appended.error());
    const auto& done = appended.value();
    if (done.is_new)
      fmt::print("{}: run {}, {} values\n", folder, done.run, done.values);
    else
      fmt::print("{}: is already run {}, nothing was appended\n", folder, done.run);
  }
  return core::Exit::kGood;
}

core::Exit history(const HistoryArguments& a) {
  if (!a.folders.empty()) return append(a);
  auto series = reports::read_history(a.file);
  if (!series) return complain(series.error());
  std::erase_if(series.value(), [&](const reports::HistorySeries& s) {
    return (!a.scene.empty() && s.scene != a.scene) || (!a.engine.empty() && s.label != a.engine);
  });
  fmt::print("{}", a.as_json ? reports::history_json(series.value()) : reports::history_text(series.value()));
  return core::Exit::kGood;
}

}  // namespace

void add_history(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<HistoryArguments>();
  CLI::App* command =
      program.add_subcommand("history", "Keep runs in a local file: append one, or show series and change points");
  command->add_option("FILE", a->file, "The history, an SQLite file; made when it is absent")->required();
  command->add_option("--add", a->folders, "Append the rows of these folders instead of showing anything");
  command->add_option("--at", a->at, "With --add: when the run was made, ISO 8601 (default: now)");
  command->add_option("--scene", a->scene, "Show only this scene");
  command->add_option("--engine", a->engine, "Show only this engine, as reports label it");
  command->add_flag("--json", a->as_json, "Print JSON");
  command->callback([a, &exit] { exit = history(*a); });
}

}  // namespace broadside::bench
