#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/commands.hpp"
#include "core/rows.hpp"
#include "reports/report.hpp"

namespace broadside::bench {
namespace {

struct ReportArguments {
  std::vector<std::string> folders;
  std::string html;
  std::string markdown;
  std::string junit;
  std::string title;
};

template <typename T>
void append(std::vector<T>& to, std::vector<T>& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

core::Result<core::RunRows> gather(const std::vector<std::string>& folders, std::vector<core::EnergySeries>& energy) {
  core::RunRows all;
  for (const std::string& folder : folders) {
    if (!std::filesystem::is_directory(folder))
      return core::Error{"no such folder", folder, "name a folder that run or demo wrote"};
    auto rows = core::read_rows(folder);
    if (!rows) return rows.error();
    core::RunRows& r = rows.value();
    if (r.cells.empty() && r.verdicts.empty() && r.samples.empty())
      return core::Error{"there is nothing to report: no cells.json, verdicts.json or samples.json", folder,
                         "run 'broadside run' and 'broadside check --json' into it first"};
    append(all.cells, r.cells);
    append(all.verdicts, r.verdicts);
    append(all.samples, r.samples);
    auto series = core::read_energy(folder);
    if (!series) return series.error();
    append(energy, series.value());
  }
  return all;
}

core::Exit report(const ReportArguments& a) {
  if (a.html.empty() && a.markdown.empty() && a.junit.empty())
    return complain({"nothing to write", "report", "give --html, --markdown or --junit"});
  reports::ReportOptions options;
  auto rows = gather(a.folders, options.energy);
  if (!rows) return complain(rows.error());
  options.title = a.title;
  options.command = "broadside report";
  for (const std::string& folder : a.folders) options.command += " " + folder;
  if (!a.html.empty())
    if (core::Status s = reports::write_html(rows.value(), options, a.html); !s) return complain(s.error());
  if (!a.markdown.empty())
    if (core::Status s = reports::write_markdown(rows.value(), options, a.markdown); !s) return complain(s.error());
  if (!a.junit.empty())
    if (core::Status s = reports::write_junit(rows.value(), options, a.junit); !s) return complain(s.error());
  return core::Exit::kGood;
}

}  // namespace

void add_report(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ReportArguments>();
  CLI::App* command =
      program.add_subcommand("report", "One page from the rows that run, check and time left in folders");
  command->add_option("DIR", a->folders, "Folders with cells.json, verdicts.json, samples.json")->required();
  command->add_option("--html", a->html, "Write one HTML file that needs no network");
  command->add_option("--markdown", a->markdown, "Write Markdown that fits a pull-request comment");
  command->add_option("--junit", a->junit, "Write JUnit XML");
  command->add_option("--title", a->title, "Title of the page");
  command->callback([a, &exit] { exit = report(*a); });
}

}  // namespace broadside::bench
