// Energy over time: one picture a scene, one line an engine.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/tunings.hpp"
#include "reports/plots/line_plot.hpp"

namespace broadside::bench::contest {
namespace {

using reports::plots::Curve;
using reports::plots::LinePlot;
using reports::plots::Placement;

double largest(const EnergyCurve& curve) {
  double most = 0.0;
  for (const double e : curve.gained_j) most = std::isfinite(e) ? std::max(most, std::abs(e)) : most;
  return most;
}

// Where there are many entrants, only engines as they ship are shown: with more lines than colors and shapes, lines
// could not be told apart.
bool is_shown(const ContestTable& table, const std::string& label) {
  constexpr std::size_t kMostLines = 12;
  const auto rows = tunings();
  return table.entrants.size() <= kMostLines ||
         std::any_of(rows.begin(), rows.end(), [&](const Tuning& t) { return t.as_shipped == label; });
}

// A range that suits most engines: twice the median of their largest changes. With the range of an engine that explodes
// all other curves would be flat lines.
double range_j(const std::map<std::string, EnergyCurve>& curves) {
  std::vector<double> all;
  all.reserve(curves.size());
  for (const auto& [label, curve] : curves) all.push_back(largest(curve));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return 2.0 * *middle;
}

// The curve, cut where it leaves the range; `words` says where.
Curve curve_of(const EnergyCurve& of, const std::string& label, double range, std::string& words) {
  Curve curve;
  curve.name = label;
  curve.x = of.time_s;
  curve.y = of.gained_j;
  for (std::size_t k = 0; k < curve.y.size(); ++k) {
    if (std::abs(curve.y[k]) <= range) continue;
    words += fmt::format("{} leaves the picture at {:.3g} s with {:.3g} J. ", label, curve.x[k], curve.y[k]);
    std::fill(curve.y.begin() + static_cast<std::ptrdiff_t>(k), curve.y.end(),
              std::numeric_limits<double>::quiet_NaN());
    break;
  }
  return curve;
}

}  // namespace

void add_energy_over_time(Document& document, const ContestTable& table) {
  std::vector<Block> figures;
  for (const SceneTable& scene : table.scenes) {
    if (scene.energy.empty()) continue;
    const double range = range_j(scene.energy);
    LinePlot plot;
    std::string left;
    std::string words;
    for (const Entrant& e : table.entrants) {
      const auto of = scene.energy.find(e.engine);
      if (of == scene.energy.end() || !is_shown(table, e.engine)) continue;
      Curve curve = curve_of(of->second, e.engine, range, left);
      curve.is_hollow = is_recommended(e.engine);
      words += fmt::format("{}: {:.3g} J at the end. ", e.engine, of->second.gained_j.back());
      plot.curves.push_back(std::move(curve));
    }
    if (plot.curves.empty()) continue;
    plot.text = {scene.scene, words, "time, s", "energy gained since the start, J"};
    plot.y_from_zero = false;
    plot.lines = {{"energy at the start", 0.0, true}};
    figures.emplace_back(Figure{file_name_of("energy", scene.scene), svg(plot, Placement::kFile),
                                svg(plot, Placement::kInline), scene.scene + ". " + left});
  }
  if (figures.empty()) return;
  document.blocks.emplace_back(Heading{"Energy over time", "energy"});
  document.blocks.emplace_back(Paragraph{
      "How much the energy has changed since the start: kinetic energy, rotation included, plus potential energy. "
      "Only an applied wrench may keep a line above zero; friction and impacts lower it. Recommended tunings are "
      "dashed. The range is twice what the median engine needs, and a line ends where it leaves that range."});
  for (Block& figure : figures) document.blocks.push_back(std::move(figure));
}

}  // namespace broadside::bench::contest
