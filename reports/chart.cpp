#include "reports/chart.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/chart_svg.hpp"
#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/page_json.hpp"

namespace broadside::reports {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kTableRows = 40;

std::string_view kind_word(SeriesKind kind) {
  switch (kind) {
    case SeriesKind::kLine:
      return "line";
    case SeriesKind::kPoints:
      return "points";
    case SeriesKind::kBar:
      return "bar";
    case SeriesKind::kArea:
      return "area";
  }
  return "line";
}

OrderedJson numbers(const std::vector<double>& values) {
  OrderedJson array = OrderedJson::array();
  for (const double value : values) array.push_back(short_number(value));
  return array;
}

OrderedJson to_json(const Axis& axis) {
  OrderedJson json{{"name", printable(axis.name)}, {"unit", printable(axis.unit)}};
  if (axis.is_log) json["log"] = true;
  if (axis.from_zero) json["from_zero"] = true;
  if (!axis.categories.empty()) {
    json["categories"] = OrderedJson::array();
    for (const std::string& name : axis.categories) json["categories"].push_back(printable(name));
  }
  return json;
}

OrderedJson to_json(const Chart& chart) {
  OrderedJson json{{"title", printable(chart.title)}, {"description", printable(chart.description)}};
  json["x"] = to_json(chart.x);
  json["y"] = to_json(chart.y);
  json["zoom"] = chart.has_zoom;
  json["series"] = OrderedJson::array();
  for (const Series& s : chart.series) {
    OrderedJson one{{"name", printable(s.name)}, {"kind", kind_word(s.kind)}, {"x", numbers(s.x)}, {"y", numbers(s.y)}};
    if (!s.low.empty()) {
      one["low"] = numbers(s.low);
      one["high"] = numbers(s.high);
    }
    if (!s.stack.empty()) one["stack"] = printable(s.stack);
    json["series"].push_back(std::move(one));
  }
  json["marks"] = OrderedJson::array();
  for (const ChartMark& mark : chart.marks)
    json["marks"].push_back({{"text", printable(mark.text)}, {mark.is_on_y ? "y" : "x", short_number(mark.at)}});
  return json;
}

std::string place_name(const Axis& axis, double value) {
  if (axis.categories.empty()) return figure(value, 5);
  const auto k = static_cast<std::size_t>(value);
  return k < axis.categories.size() ? axis.categories[k] : figure(value);
}

std::string value_text(const Series& s, std::size_t k, bool is_down) {
  std::string text = figure(is_down ? s.x[k] : s.y[k], 4);
  if (!s.low.empty()) text += " [" + figure(s.low[k], 4) + ", " + figure(s.high[k], 4) + "]";
  return text;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? OrderedJson(value).dump() : "";
}

}  // namespace

std::string chart_table(const Chart& chart) {
  const bool is_down = !chart.y.categories.empty();
  const Axis& along = is_down ? chart.y : chart.x;
  const Axis& of = is_down ? chart.x : chart.y;
  // Series may have values at different places on x.
  std::map<double, std::vector<std::string>> rows;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const Series& one = chart.series[s];
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      std::vector<std::string>& row = rows[is_down ? one.y[k] : one.x[k]];
      row.resize(chart.series.size());
      row[s] = value_text(one, k, is_down);
    }
  }
  const std::size_t stride = along.categories.empty() ? (rows.size() + kTableRows - 1) / kTableRows : 1;
  std::string caption = html(chart.title);
  if (!of.unit.empty()) caption += ", " + html(of.name) + " in " + html(of.unit);
  if (stride > 1) caption += "; every " + counted(stride) + "th of " + counted(rows.size(), "place");
  std::vector<Column> columns{{along.name}};
  for (const Series& s : chart.series) columns.push_back({s.name, true});
  std::string body;
  std::size_t n = 0;
  for (const auto& [at, row] : rows) {
    if (n++ % std::max<std::size_t>(stride, 1) != 0) continue;
    std::string cells;
    for (std::size_t s = 0; s < row.size(); ++s)
      cells += figure_cell(chart.series[s].name, row[s].empty() ? absent_value("none") : html(row[s]));
    body += element("tr", row_head(html(place_name(along, at))), cells);
  }
  const std::string table = element("table", element("caption", caption), table_head(columns), element("tbody", body));
  std::string marks;
  for (const ChartMark& mark : chart.marks) marks += element("li", html(mark.text), " at ", html(figure(mark.at, 5)));
  return table + (marks.empty() ? "" : element("ul.plain", marks));
}

std::string ChartBook::figure(Chart chart) {
  if (std::all_of(chart.series.begin(), chart.series.end(), [](const Series& s) { return s.x.empty(); })) return "";
  const std::string title = html(chart.title);
  const std::string drawn = element("div.chart-place", {{"data-chart", std::to_string(charts_.size())}},
                                    chart_svg(chart, plots::Placement::kInline));
  const std::string summary = element("summary", "The same as a table", element("span.unseen", ": ", title));
  std::string out = element("figure.chart", element("figcaption", title), drawn,
                            element("details.beside", summary, chart_table(chart)));
  charts_.push_back(std::move(chart));
  return out;
}

std::string ChartBook::json() const {
  OrderedJson all = OrderedJson::array();
  for (const Chart& chart : charts_) all.push_back(to_json(chart));
  return script_safe(all.dump(-1, ' ', true, OrderedJson::error_handler_t::replace));
}

std::string chart_csv(const Chart& chart) {
  std::string text = "series," + csv_cell(chart.x.name + (chart.x.unit.empty() ? "" : " (" + chart.x.unit + ")")) +
                     "," + csv_cell(chart.y.name + (chart.y.unit.empty() ? "" : " (" + chart.y.unit + ")")) +
                     ",low,high\n";
  const auto place = [](const Axis& axis, double value) {
    return axis.categories.empty() ? csv_number(value) : csv_cell(place_name(axis, value));
  };
  for (const Series& s : chart.series)
    for (std::size_t k = 0; k < s.x.size(); ++k)
      text += csv_cell(s.name) + "," + place(chart.x, s.x[k]) + "," + place(chart.y, s.y[k]) + "," +
              (s.low.empty() ? "," : csv_number(s.low[k]) + "," + csv_number(s.high[k])) + "\n";
  return text;
}

}  // namespace broadside::reports
