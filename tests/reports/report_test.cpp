// The three kinds of report: complete, well-formed, deterministic, and safe with hostile names.
#include "reports/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "core/whole_file.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "tests/reports/markup_checker.hpp"
#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

using testing_markup::check_markup;
using testing_markup::Element;
using testing_markup::Markup;
using testing_rows::sample_rows;

// Tests of the page, which a build may leave out.
class HtmlReport : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_html_page()) GTEST_SKIP() << "built with BROADSIDE_REPORT_HTML=OFF";
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

// Every text that a user, a scene file, a library or a machine may choose.
core::RunRows rows_named(const std::string& name) {
  core::RunRows rows = sample_rows();
  const auto poison = [&](core::Stamp& stamp) {
    stamp.scene_name = stamp.engine_build = stamp.broadside_build = stamp.machine = name;
    stamp.engine += name;
    stamp.settings_short += name;
  };
  for (core::Cell& cell : rows.cells) {
    poison(cell.stamp);
    cell.reason += name;
    cell.trace_file += name;
    cell.notes[name] = cell.notes["pairs: " + name] = cell.notes["command"] = cell.notes["stand-in"] = name;
  }
  for (core::CellVerdicts& cell : rows.verdicts) {
    poison(cell.stamp);
    cell.trace_file += name;
    for (core::Verdict& v : cell.verdicts) {
      v.validator += name;
      v.origin = v.explanation = v.baseline = v.unit = v.worst.field = name;
    }
  }
  for (core::Sample& sample : rows.samples) {
    poison(sample.stamp);
    for (core::StageSeries& series : sample.stages)
      if (series.stage != "frame") series.stage += name;
  }
  return rows;
}

ReportOptions options_named(const std::string& name) {
  return {.title = name, .command = name, .repeat = {name}, .generated_at = name};
}

constexpr char kScript[] = "</script><script>alert(1)</script>";

TEST_F(HtmlReport, IsWellFormedAndSelfContained) {
  const std::string page = html_page(sample_rows(), {.command = "broadside run x"});
  const Markup markup = check_markup(page, true);
  EXPECT_EQ(markup.problem, "");
  for (const Element& element : markup.elements) {
    EXPECT_FALSE(element.attributes.contains("src")) << element.name;
    // Only links within the page.
    if (element.attributes.contains("href")) {
      EXPECT_EQ(element.attributes.at("href")[0], '#') << element.name;
    }
    EXPECT_NE(element.name, "link");
  }
  // The script contains the addresses by which XML's namespaces are named; the page's policy forbids fetching any.
  const std::string body = page.substr(0, page.rfind("<script>\n"));
  EXPECT_FALSE(has(body, "http://") || has(body, "https://") || has(body, "@import") || has(body, "url("));
  EXPECT_TRUE(has(page, "default-src 'none'"));
}

TEST_F(HtmlReport, OpensWithTheVerdictInOneSentence) {
  const std::string page = html_page(sample_rows(), {});
  const std::size_t sentence = page.find(
      "2 of 108 verdicts failed on octree-cpu[variant=printed-E3]: center-of-mass (worst at "
      "step 412, bodies 3 and 17), restitution; 3 cells were not measured.");
  ASSERT_NE(sentence, std::string::npos);
  EXPECT_LT(sentence, page.find("<main>"));
}

TEST_F(HtmlReport, EveryVerdictIsAWordWithASymbolThatOpens) {
  const core::RunRows rows = sample_rows();
  const std::string page = html_page(rows, {});
  const Markup markup = check_markup(page, true);
  std::size_t verdicts = 0;
  for (const core::CellVerdicts& cell : rows.verdicts) verdicts += cell.verdicts.size();
  std::size_t places = 0;
  for (const Element& element : markup.elements)
    places += element.name == "details" && element.attributes.contains("name") ? 1U : 0U;
  EXPECT_EQ(places, verdicts);
  EXPECT_TRUE(has(page, "0.0183 kg m"));
  EXPECT_TRUE(has(page, "step 412, bodies 3 and 17, contact.post.x"));
  EXPECT_TRUE(has(page, "the exact set of the recorded boxes"));
  EXPECT_TRUE(has(page, "not a number"));
}

TEST_F(HtmlReport, AbsenceIsSaidInWords) {
  const std::string page = html_page(sample_rows(), {});
  EXPECT_GE(occurrences(page, "not measured: no device"), 2U);
  EXPECT_TRUE(has(page, "crashed: signal 6 (abort) after frame 12"));
  core::RunRows untimed = sample_rows();
  untimed.samples.clear();
  EXPECT_TRUE(has(html_page(untimed, {}), "Not measured: no timed run"));
}

TEST_F(HtmlReport, TimesWithoutAProofAreStruckOutWithTheReason) {
  const core::RunRows rows = sample_rows();
  const std::string page = html_page(rows, {});
  EXPECT_TRUE(has(page, "struck out: center-of-mass failed on this stamp"));
  EXPECT_TRUE(has(page, "struck out: the timed run&#39;s answer differs"));
  core::RunRows proven = rows;
  std::erase_if(proven.samples, [](const core::Sample& s) { return s.stamp.settings_short != "levels=A"; });
  EXPECT_FALSE(has(html_page(proven, {}), "<s>"));
}

TEST_F(HtmlReport, AHostileNameStaysText) {
  for (const std::string name :
       {kScript, "\"><img src=x onerror=alert(1)>", "' onmouseover='alert(1)", "&lt;b&gt;", "\x01\xFF"}) {
    const std::string page = html_page(rows_named(name), options_named(name));
    const Markup markup = check_markup(page, true);
    EXPECT_EQ(markup.problem, "") << name;
    std::size_t run = 0;
    for (const Element& element : markup.elements)
      run += element.name == "script" && !element.attributes.contains("type") ? 1U : 0U;
    EXPECT_EQ(run, 1U) << name << ": the page's own";
    EXPECT_EQ(markup.count("img"), 0U) << name;
    for (const Element& element : markup.elements)
      for (const auto& [key, value] : element.attributes) EXPECT_FALSE(key.starts_with("on")) << key;
    EXPECT_TRUE(has(page, html(name))) << name;
  }
}

TEST_F(HtmlReport, NoRowsAndHalfRowsAreStillAPage) {
  EXPECT_TRUE(has(html_page({}, {}), "Nothing was judged."));
  const core::RunRows all = sample_rows();
  EXPECT_EQ(check_markup(html_page({.cells = all.cells}, {}), true).problem, "");
  EXPECT_EQ(check_markup(html_page({.verdicts = all.verdicts}, {}), true).problem, "");
  EXPECT_EQ(check_markup(html_page({.samples = all.samples}, {}), true).problem, "");
  core::RunRows empty_series;
  empty_series.samples.push_back({.stages = {{"broad", {}}, {"frame", {}}}});
  EXPECT_EQ(check_markup(html_page(empty_series, {}), true).problem, "");
}

TEST(Reports, AStandInMeshIsSaidWhicheverNoteSaysIt) {
  core::RunRows rows = sample_rows();
  for (core::Cell& cell : rows.cells) cell.notes.erase("stand-in");
  EXPECT_FALSE(has(html_page(rows, {}), "Stand-in mesh"));
  EXPECT_FALSE(has(markdown_text(rows, {}), "Stand-in mesh"));
  rows.cells[0].notes["mesh dragon"] = "a decimated scan (STAND-IN)";
  if (has_html_page()) {
    EXPECT_TRUE(has(html_page(rows, {}), "Stand-in mesh.</strong> mesh dragon: a decimated scan (STAND-IN)"));
  }
  EXPECT_TRUE(has(markdown_text(rows, {}), "mesh dragon: a decimated scan (STAND-IN)"));
}

TEST(Reports, TheSameRowsGiveTheSameBytes) {
  EXPECT_EQ(html_page(sample_rows(), {}), html_page(sample_rows(), {}));
  EXPECT_EQ(markdown_text(sample_rows(), {}), markdown_text(sample_rows(), {}));
  EXPECT_EQ(junit_xml(sample_rows(), {}), junit_xml(sample_rows(), {}));
}

TEST(MarkdownReport, HasSentenceMatrixFailuresWithFrameAndPairAndTimes) {
  const std::string text = markdown_text(sample_rows(), {});
  EXPECT_TRUE(has(text, "2 of 108 verdicts failed"));
  EXPECT_TRUE(has(text, "| center-of-mass | octree-cpu\\[variant=printed-E3\\] | 0.0183 kg m |"));
  EXPECT_TRUE(has(text, "| 412 | bodies 3 and 17 |"));
  EXPECT_TRUE(has(text, "| octree-gpu | not measured: no device |"));
  EXPECT_TRUE(has(text, "struck out: center-of-mass failed"));
  EXPECT_TRUE(has(text, "~~"));
}

TEST(MarkdownReport, EveryRowOfATableHasAsManyPlacesAsItsHead) {
  const std::string text = markdown_text(sample_rows(), {});
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const std::size_t bars = occurrences(line, "|") - occurrences(line, "\\|");
    if (!line.starts_with("|")) {
      columns = 0;
    } else if (columns == 0) {
      columns = bars;
    } else {
      EXPECT_EQ(bars, columns) << line;
    }
  }
}

TEST(MarkdownReport, AHostileNameStaysText) {
  const std::string text = markdown_text(rows_named(kScript), options_named(kScript));
  EXPECT_FALSE(has(text, "<script"));
  EXPECT_FALSE(has(text, "</script"));
  EXPECT_TRUE(has(text, "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;"));
  const std::string table = markdown_text(rows_named("a|b\n\n# big @everyone [x](http://y) `c`"), {});
  EXPECT_FALSE(has(table, "\n# big") || has(table, "@everyone") || has(table, "http://") || has(table, "a|b"));
}

TEST(MarkdownReport, StaysBelowTheLimitAndSaysWhatItLeftOut) {
  core::RunRows rows = sample_rows();
  const std::size_t cells = rows.verdicts.size();
  for (int copy = 0; copy < 200; ++copy) {
    for (std::size_t k = 0; k < cells; ++k) {
      rows.verdicts.push_back(rows.verdicts[k]);
      rows.verdicts.back().stamp.settings_short += " copy " + std::to_string(copy);
      rows.verdicts.back().stamp.settings += std::to_string(copy);
    }
  }
  const std::string text = markdown_text(rows, {});
  EXPECT_LE(text.size(), kMarkdownLimit);
  EXPECT_TRUE(has(text, "left out"));
  const std::string long_names =
      markdown_text(rows_named(std::string(100'000, 'x')), options_named(std::string(100'000, 'y')));
  EXPECT_LE(long_names.size(), kMarkdownLimit);
}

TEST(JunitReport, HasASuitePerTraceAndACasePerVerdict) {
  const core::RunRows rows = sample_rows();
  const Markup markup = check_markup(junit_xml(rows, {}), false);
  ASSERT_EQ(markup.problem, "");
  std::size_t verdicts = 0;
  for (const core::CellVerdicts& cell : rows.verdicts) verdicts += cell.verdicts.size();
  EXPECT_EQ(markup.count("testsuite"), rows.cells.size());
  EXPECT_EQ(markup.count("testcase"), verdicts + rows.cells.size());
  EXPECT_EQ(markup.count("failure"), 2U);
  EXPECT_EQ(markup.count("error"), 2U);  // one inconclusive verdict, one crashed cell
  EXPECT_EQ(markup.count("skipped"),
            34U);  // 4 traces of boxes alone x 8 laws of contacts, and 2 cells without a device
}

TEST(JunitReport, CountsInAttributesAreTheCountsOfElements) {
  const Markup markup = check_markup(junit_xml(sample_rows(), {}), false);
  std::map<std::string, std::size_t> sums;
  for (const Element& element : markup.elements)
    if (element.name == "testsuite")
      for (const char* key : {"tests", "failures", "errors", "skipped"})
        sums[key] += std::stoul(element.attributes.at(key));
  EXPECT_EQ(sums["tests"], markup.count("testcase"));
  EXPECT_EQ(sums["failures"], markup.count("failure"));
  EXPECT_EQ(sums["errors"], markup.count("error"));
  EXPECT_EQ(sums["skipped"], markup.count("skipped"));
  for (const char* key : {"tests", "failures", "errors", "skipped"})
    EXPECT_EQ(std::stoul(markup.elements[0].attributes.at(key)), sums[key]) << key;
}

TEST(JunitReport, AFailureNamesStepAndBodiesAndAnAbsentCellItsReason) {
  const std::string text = junit_xml(sample_rows(), {});
  EXPECT_TRUE(
      has(text, "measured 0.0183 kg m, limit 1.66e-5 kg m, worst at step 412, bodies 3 and 17, contact.post.x"));
  EXPECT_TRUE(has(text, "<skipped message=\"not measured: no device\"/>"));
  EXPECT_TRUE(has(text, "<error type=\"crashed\" message=\"crashed: signal 6 (abort)"));
  EXPECT_TRUE(has(text, "<error type=\"inconclusive\""));
}

TEST(JunitReport, NamesWithinASuiteDiffer) {
  const Markup markup = check_markup(junit_xml(sample_rows(), {}), false);
  std::vector<std::string> names;
  for (const Element& element : markup.elements)
    if (element.name == "testcase")
      names.push_back(element.attributes.at("classname") + "." + element.attributes.at("name"));
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(JunitReport, AHostileNameStaysText) {
  for (const std::string name : {kScript, "]]>", "\" x=\"", "\x01\x02\xFF"}) {
    const Markup markup = check_markup(junit_xml(rows_named(name), options_named(name)), false);
    EXPECT_EQ(markup.problem, "") << name;
    EXPECT_EQ(markup.count("script"), 0U);
  }
}

TEST(HtmlPage, ShowsPartsThatWereMadeElsewhere) {
  ReportOptions options;
  options.guests.push_back({"paper", "The <paper>", "<h3 id=\"paper-one\">One</h3><p>text</p>", ".own{color:red}\n"});
  const std::string page = html_page(sample_rows(), options);
  EXPECT_NE(page.find("<section id=\"paper\"><h2>The &lt;paper&gt;</h2><h3 id=\"paper-one\">"), std::string::npos);
  EXPECT_NE(page.find("<a href=\"#paper\">The &lt;paper&gt;</a>"), std::string::npos) << "in the contents";
  EXPECT_LT(page.find(".own{color:red}"), page.find("</style>"));
  EXPECT_EQ(testing_markup::check_markup(page, true).problem, "");
}

TEST(Reports, AreWrittenWholeOrNotAtAll) {
  const char* keep = std::getenv("BROADSIDE_REPORT_PREVIEW");  // a folder in which the pages are left to be looked at
  const std::filesystem::path folder =
      keep != nullptr ? keep : std::filesystem::temp_directory_path() / ("report_test_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const core::RunRows rows = sample_rows();
  EXPECT_EQ(write_html(rows, {}, folder / "report.html").ok(), has_html_page());
  ASSERT_TRUE(write_markdown(rows, {}, folder / "report.md").ok());
  ASSERT_TRUE(write_junit(rows, {}, folder / "junit.xml").ok());
  if (has_html_page()) {
    EXPECT_EQ(core::read_whole_file(folder / "report.html").value(), html_page(rows, {}));
  }
  EXPECT_EQ(core::read_whole_file(folder / "report.md").value(), markdown_text(rows, {}));
  EXPECT_EQ(core::read_whole_file(folder / "junit.xml").value(), junit_xml(rows, {}));
  EXPECT_FALSE(write_html(rows, {}, folder / "no" / "report.html").ok());
  if (keep == nullptr) std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace broadside::reports
