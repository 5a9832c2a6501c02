// Figure A2: mean penetration over beta and delta.
#include <fmt/format.h>

#include <cmath>

#include "bench/paper/measured.hpp"
#include "bench/paper/paper_plan.hpp"
#include "bench/paper/sections.hpp"
#include "reports/plots/heat_map.hpp"

namespace broadside::bench::paper {
namespace {

const PaperRow* find(const RowTable& rows, double beta, double delta_m) {
  for (const PaperRow* row : rows.rows())
    if (row->beta == beta && row->delta_m == delta_m) return row;
  return nullptr;
}

}  // namespace

void add_figure_a2(Document& document, Rows all) {
  const RowTable rows(all, "figureA2");
  if (rows.is_empty()) return;
  const PaperRow& first = *rows.rows().front();
  document.blocks.emplace_back(Heading{"Figure A2: mean penetration over beta and delta", "figureA2"});
  document.blocks.emplace_back(
      Paragraph{fmt::format("Free-fall stacking of {} {} bodies at dt = 0.001 s, {} frames from the moment at which "
                            "the lowest box reaches the "
                            "floor. Depth of contacts between bodies before each application, over every recorded "
                            "frame. The published figure "
                            "gives colors only, so there is nothing to set beside these figures.",
                            first.count, first.model, first.frames)});

  reports::plots::HeatMap map;
  map.text = {"Mean penetration depth", "", "beta", "delta"};
  map.unit = "m";
  Table table{"figureA2",
              "Depth of body contacts, m",
              {"beta", "delta, m", "mean depth", "largest depth", "share deeper than delta", "contacts"},
              {}};
  for (const double beta : penetration_betas()) map.columns.push_back(fmt::format("{:g}", beta));
  for (const double delta_m : penetration_deltas_m()) {
    map.rows.push_back(fmt::format("{:g} mm", 1e3 * delta_m));
    std::vector<double> values;
    for (const double beta : penetration_betas()) {
      const PaperRow* row = find(rows, beta, delta_m);
      const bool is_usable = row != nullptr && row->absence.empty() && row->is_admitted;
      const Penetration p = pooled(is_usable ? row->penetration : std::vector<core::PenetrationStatistics>{});
      values.push_back(p.mean_m);
      table.rows.push_back({{fmt::format("{:g}", beta), beta},
                            {fmt::format("{:g}", delta_m), delta_m},
                            is_usable ? number_cell(p.mean_m, 4) : TableCell{"absent"},
                            number_cell(p.largest_m, 4),
                            number_cell(p.share_above_slop, 3),
                            {std::to_string(p.contacts), static_cast<double>(p.contacts)}});
      map.text.description +=
          fmt::format("beta {:g}, delta {:g} mm: {}. ", beta, 1e3 * delta_m, number_cell(p.mean_m, 3).text);
    }
    map.values.push_back(std::move(values));
  }
  using reports::plots::Placement;
  document.blocks.emplace_back(Figure{"figureA2", svg(map, Placement::kFile), svg(map, Placement::kInline),
                                      "Mean depth of contacts between bodies; darker is deeper."});
  document.blocks.emplace_back(std::move(table));
  document.blocks.emplace_back(Notes{reasons(rows)});
}

}  // namespace broadside::bench::paper
