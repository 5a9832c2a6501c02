#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.hpp"
#include "bench/paper/report_part.hpp"
#include "bench/process/program.hpp"
#include "bench/record/playback_of_trace.hpp"
#include "core/rows.hpp"
#include "core/whole_file.hpp"
#include "reports/chart_svg.hpp"
#include "reports/exchange.hpp"
#include "reports/report.hpp"

namespace broadside::bench {
namespace {

struct ReportArguments {
  std::vector<std::string> folders;
  std::string html, markdown, junit;
  std::string google_benchmark, smaller_is_better, csv;
  std::string plots;
  bool with_png = false;
  std::string history;
  std::string paper;
  std::string title;
};

template <typename T>
void append(std::vector<T>& to, std::vector<T>&& from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

// Adds the paper's experiments of a folder to the report. False when there are none.
core::Result<bool> add_paper(const std::string& folder, reports::ReportOptions& options) {
  auto part =
      paper::report_part(folder, options.guests.empty() ? "paper" : fmt::format("paper{}", options.guests.size() + 1));
  if (!part) return part.error();
  if (!part.value()) return false;
  options.guests.push_back(*std::move(part).value());
  return true;
}

// The rows of all folders, with what the page shows from the traces there.
core::Result<core::RunRows> gather(const ReportArguments& a, reports::ReportOptions& options) {
  core::RunRows all;
  for (const std::string& folder : a.folders) {
    if (!std::filesystem::is_directory(folder))
      return core::Error{"no such folder", folder, "name a folder that run or demo wrote"};
    auto rows = core::read_rows(folder);
    if (!rows) return rows.error();
    core::RunRows& r = rows.value();
    auto has_paper = add_paper(folder, options);
    if (!has_paper) return has_paper.error();
    if (r.cells.empty() && r.verdicts.empty() && r.samples.empty() && !has_paper.value())
      return core::Error{"there is nothing to report: no cells.json, verdicts.json or samples.json", folder,
                         "run 'broadside run' and 'broadside check --json' into it first"};
    if (!a.html.empty()) append(options.playbacks, playbacks_of(r, folder, share_of(a.folders.size())));
    if (!a.html.empty() || !a.plots.empty()) append(options.series, penetration_of(r, folder));
    append(all.cells, std::move(r.cells));
    append(all.verdicts, std::move(r.verdicts));
    append(all.samples, std::move(r.samples));
    auto energy = core::read_energy(folder);
    if (!energy) return energy.error();
    append(options.energy, std::move(energy).value());
  }
  return all;
}

// Converts the picture with rsvg-convert of Debian's librsvg2-bin, at 300 dots per inch for a width of 640 points.
core::Status make_png(const std::filesystem::path& picture) {
  std::filesystem::path png = picture;
  png.replace_extension(".png");
  auto run = run_program("rsvg-convert",
                         {"--zoom", "3", "--background-color", "white", "-o", png.string(), picture.string()}, "");
  if (!run || run.value() != 0)
    return core::Error{"no PNG could be made of it", picture.string(),
                       "install rsvg-convert (Debian: librsvg2-bin), or take the SVG files"};
  return core::Done{};
}

core::Status write_plots(const ReportArguments& a, const core::RunRows& rows, const reports::ReportOptions& options) {
  if (!reports::has_html_page())
    return core::Error{"this build has no charts (BROADSIDE_REPORT_HTML=OFF)", a.plots,
                       "take --csv, or build with the page"};
  auto written = reports::write_charts(reports::page_charts(rows, options), a.plots);
  if (!written) return written.error();
  if (a.with_png)
    for (const std::filesystem::path& picture : written.value())
      if (core::Status s = make_png(picture); !s) return s;
  return core::Done{};
}

core::Status write_all(const ReportArguments& a, const core::RunRows& rows, const reports::ReportOptions& options) {
  if (!a.html.empty())
    if (core::Status s = reports::write_html(rows, options, a.html); !s) return s;
  if (!a.markdown.empty())
    if (core::Status s = reports::write_markdown(rows, options, a.markdown); !s) return s;
  if (!a.junit.empty())
    if (core::Status s = reports::write_junit(rows, options, a.junit); !s) return s;
  if (!a.google_benchmark.empty())
    if (core::Status s = core::write_whole_file(a.google_benchmark, reports::google_benchmark_json(rows)); !s) return s;
  if (!a.smaller_is_better.empty())
    if (core::Status s = core::write_whole_file(a.smaller_is_better, reports::smaller_is_better_json(rows)); !s)
      return s;
  if (!a.csv.empty())
    if (core::Status s = core::write_whole_file(a.csv, reports::figures_csv(rows)); !s) return s;
  if (!a.plots.empty()) return write_plots(a, rows, options);
  return core::Done{};
}

core::Exit report(const ReportArguments& a) {
  if (a.html.empty() && a.markdown.empty() && a.junit.empty() && a.google_benchmark.empty() &&
      a.smaller_is_better.empty() && a.csv.empty() && a.plots.empty())
    return complain(
        {"nothing to write", "report", "give --html, --markdown, --junit, --csv, --plots or another output"});
  if (a.with_png && a.plots.empty())
    return complain({"--png without a folder", "report", "give --plots FOLDER with it"});
  reports::ReportOptions options;
  options.title = a.title;
  options.command = "broadside report";
  for (const std::string& folder : a.folders) options.command += " " + folder;
  auto rows = gather(a, options);
  if (!rows) return complain(rows.error());
  if (!a.paper.empty()) {
    auto has_paper = add_paper(a.paper, options);
    if (!has_paper) return complain(has_paper.error());
    if (!has_paper.value())
      return complain({"there is no rows.json of the paper's experiments", a.paper,
                       "name a folder that 'broadside paper' or 'merge' wrote"});
  }
  if (!a.history.empty()) {
    auto history = reports::read_history(a.history);
    if (!history) return complain(history.error());
    options.history = std::move(history).value();
  }
  if (core::Status s = write_all(a, rows.value(), options); !s) return complain(s.error());
  return core::Exit::kGood;
}

}  // namespace

void add_report(CLI::App& program, core::Exit& exit) {
  auto a = std::make_shared<ReportArguments>();
  CLI::App* command =
      program.add_subcommand("report", "Make one page from the rows that run, check and time left in folders");
  command->add_option("DIR", a->folders, "Folders with cells.json, verdicts.json, samples.json")->required();
  command->add_option("--html", a->html, "Write one HTML file that needs no network");
  command->add_option("--markdown", a->markdown, "Write Markdown that fits a pull-request comment");
  command->add_option("--junit", a->junit, "Write JUnit XML");
  command->add_option("--google-benchmark", a->google_benchmark,
                      "Write admitted times as Google Benchmark's JSON, every run, for its compare.py");
  command->add_option("--smaller-is-better", a->smaller_is_better,
                      "Write admitted times and counters as customSmallerIsBetter JSON");
  command->add_option("--csv", a->csv, "Write every figure as CSV");
  command->add_option("--plots", a->plots, "Write each chart as SVG and CSV into this folder");
  command->add_flag("--png", a->with_png, "With --plots: PNG files too (needs rsvg-convert)");
  command->add_option("--history", a->history, "Show earlier runs from this file of 'broadside history'");
  command->add_option("--paper", a->paper,
                      "Show the paper's tables and figures from this folder of 'broadside paper'; a DIR that has them "
                      "shows them anyway");
  command->add_option("--title", a->title, "Title of the page");
  command->callback([a, &exit] { exit = report(*a); });
}

}  // namespace broadside::bench
