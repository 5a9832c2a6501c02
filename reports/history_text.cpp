// Series and change points as text and as JSON; declared in history.hpp.
#include <nlohmann/json.hpp>

#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/history.hpp"

namespace broadside::reports {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string change_share(const ChangePoint& change) {
  if (change.before == 0.0) return "";
  const double share = change.after / change.before - 1.0;
  return " (" + std::string(share > 0.0 ? "+" : "") + percent(share) + ")";
}

std::string value_text(const HistorySeries& series, double value) {
  return series.unit.empty() ? figure(value, 6) : quantity(value, series.unit, 4);
}

}  // namespace

std::string history_text(const std::vector<HistorySeries>& series) {
  if (series.empty()) return "no series\n";
  std::string text;
  std::string machine;
  std::string cell;
  std::uint64_t changes = 0;
  for (const HistorySeries& s : series) {
    if (s.machine != machine) text += (text.empty() ? "" : "\n") + printable(s.machine) + "\n";
    if (const std::string here = s.machine + "\n" + s.scene + "\n" + s.label; here != cell) {
      text += "  " + printable(s.scene) + " " + printable(s.label) + "\n";
      cell = here;
    }
    machine = s.machine;
    text += "    " + printable(s.metric) + ": " + counted(s.points.size(), "run") + ", last " +
            value_text(s, s.points.back().value) + "\n";
    for (const ChangePoint& change : s.changes) {
      const HistoryPoint& point = s.points[change.index];
      text += "      changed at run " + std::to_string(point.run) + " (" + printable(point.at) +
              "): " + value_text(s, change.before) + " to " + value_text(s, change.after) + change_share(change) +
              ", p " + figure(change.p, 2) + "\n";
      ++changes;
    }
  }
  return counted(series.size()) + " series, " + counted(changes, "change point") + ".\n" + text;
}

std::string history_json(const std::vector<HistorySeries>& series) {
  OrderedJson all = OrderedJson::array();
  for (const HistorySeries& s : series) {
    OrderedJson points = OrderedJson::array();
    for (const HistoryPoint& p : s.points)
      points.push_back({{"run", p.run}, {"at", p.at}, {"build", p.build}, {"value", p.value}});
    OrderedJson changes = OrderedJson::array();
    for (const ChangePoint& c : s.changes)
      changes.push_back({{"run", s.points[c.index].run}, {"before", c.before}, {"after", c.after}, {"p", c.p}});
    all.push_back({{"machine", s.machine},
                   {"scene", s.scene},
                   {"label", s.label},
                   {"metric", s.metric},
                   {"unit", s.unit},
                   {"points", std::move(points)},
                   {"changes", std::move(changes)}});
  }
  const OrderedJson document{{"format", "broadside-history"}, {"version", 1}, {"series", std::move(all)}};
  return document.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace broadside::reports
