// How far narrow phases are from the exact answer: a table by kind of pair, and histograms of the errors.
#include <algorithm>
#include <map>
#include <sstream>

#include "reports/element.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/html_sections.hpp"

namespace broadside::reports {
namespace {

std::string table_of(const AgreementGrid& grid) {
  std::vector<Column> columns{{"engine"}};
  for (const std::string& column : grid.columns) columns.push_back({column});
  std::string rows;
  for (const auto& [label, texts] : grid.rows) {
    std::string cells;
    for (std::size_t k = 0; k < texts.size(); ++k)
      cells += text_cell(grid.columns[k], texts[k].empty() ? absent_value("none") : html(texts[k]));
    rows += element("tr", row_head(html(label)), cells);
  }
  return element("table.cells", table_head(columns), element("tbody", rows));
}

std::string power_of_ten(int power) {
  return "1e" + std::to_string(power);
}

Chart chart_of(const std::string& what, const AgreementHistograms& histograms, const SceneView& scene) {
  Chart chart{.title = histograms.title,
              .description = "Of " + scene.name + ": the share of each engine's answered pairs whose " + what +
                             " error lies between one power of ten and the next.",
              .x = {.name = "share of answered pairs", .unit = "%", .from_zero = true},
              .y = {.name = "off by", .unit = histograms.unit}};
  for (std::size_t k = 0; k < histograms.bins; ++k) {
    const int power = histograms.lowest_power + static_cast<int>(k);
    chart.y.categories.push_back(k + 1 < histograms.bins ? "below " + power_of_ten(power)
                                                         : power_of_ten(power - 1) + " or more");
  }
  for (const auto& [label, counts] : histograms.rows) {
    double all = 0.0;
    for (const double count : counts) all += count;
    Series bars{.name = label, .kind = SeriesKind::kBar};
    for (std::size_t k = 0; k < counts.size() && all > 0.0; ++k) {
      bars.x.push_back(100.0 * counts[k] / all);
      bars.y.push_back(static_cast<double>(k));
    }
    chart.series.push_back(std::move(bars));
  }
  return chart;
}

}  // namespace

std::string agreement_section(const SceneView& scene, PageParts& page) {
  const AgreementGrid grid = agreement_of(scene);
  if (grid.columns.empty()) return "";
  std::string charts;
  for (const auto& [what, histograms] : agreement_histograms_of(scene))
    charts += page.charts.figure(chart_of(what, histograms, scene));
  return element("section", element("h3", "Agreement with the exact answer"), table_of(grid),
                 charts.empty() ? "" : element("div.charts", charts));
}

}  // namespace broadside::reports
