// The three kinds of report of a run: a page to read, a comment for a pull request, a file for a CI server.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/energy_series.hpp"
#include "core/rows.hpp"
#include "reports/chart.hpp"
#include "reports/frame_series.hpp"
#include "reports/history.hpp"
#include "reports/playback.hpp"

namespace broadside::reports {

inline constexpr const char* kDefaultTitle = "Collision engines compared";

// A part of the page that other code made: its body is escaped HTML, with ids that begin with the part's id.
struct GuestPart {
  std::string id;     // "paper"
  std::string title;  // plain text
  std::string body;
  std::string style;  // CSS of its own, in addition to the page's
};

struct ReportOptions {
  std::string title;                // empty = kDefaultTitle
  std::string note;                 // a sentence under the result; empty = none
  std::string command;              // the command line that made the rows; empty = not shown
  std::vector<std::string> repeat;  // more commands for "how to repeat", in order
  std::string generated_at;         // printed as given; empty = left out, and then the same rows give the same bytes
  // Data beside the rows, for the page alone.
  std::vector<core::EnergySeries> energy;
  std::vector<Playback> playbacks;
  std::vector<FrameSeries> series;
  std::vector<HistorySeries> history;
  std::vector<GuestPart> guests;
};

// False for a build without the page (BROADSIDE_REPORT_HTML=OFF). Then html_page is empty, and write_html is an error
// that says so.
bool has_html_page();
// Whether this build has charts and the 3-D view. Without npm at build time the page has only tables and bars.
bool has_page_bundle();

// One self-contained file that fetches nothing: readable without scripts, from a phone to paper, light or dark.
std::string html_page(const core::RunRows& rows, const ReportOptions& options);

// The charts of the page, for files of their own; none where the page was not built.
std::vector<Chart> page_charts(const core::RunRows& rows, const ReportOptions& options);

// GitHub-flavored Markdown for a comment, at most kMarkdownLimit bytes. Parts that do not fit are left out, the last
// parts first, and the text says how much is missing.
constexpr std::size_t kMarkdownLimit = 60'000;
std::string markdown_text(const core::RunRows& rows, const ReportOptions& options);

// JUnit XML: one testsuite per trace, one testcase per verdict and one, "recorded", for the cell itself.
//   fail                        failure: CI is red
//   inconclusive                error: JUnit's word for a test that reached no result; a skip would look green
//   not applicable              skipped, with the reason
//   not measured, unsupported   "recorded" is skipped, with the reason
//   crashed, timed out,
//   interrupted, failed         "recorded" is an error
std::string junit_xml(const core::RunRows& rows, const ReportOptions& options);

// Written beside the final name and renamed.
core::Status write_html(const core::RunRows& rows, const ReportOptions& options, const std::filesystem::path& file);
core::Status write_markdown(const core::RunRows& rows, const ReportOptions& options, const std::filesystem::path& file);
core::Status write_junit(const core::RunRows& rows, const ReportOptions& options, const std::filesystem::path& file);

}  // namespace broadside::reports
