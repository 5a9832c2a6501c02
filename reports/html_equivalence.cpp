// Equivalence cards and known defects on the page.
#include "reports/declared.hpp"
#include "reports/element.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"

namespace broadside::reports {
namespace {

std::string card_html(const EngineCard& card) {
  const std::uint64_t differences = card.differences();
  const std::string said =
      differences == 0 ? "nothing differs from the scene" : counted(differences, "difference") + " from the scene";
  std::string rows;
  for (const core::EquivalenceFact& fact : card.facts)
    rows += element(fact.differs() ? "tr.differs" : "tr", row_head(html(fact.property)),
                    text_cell("this engine", html(fact.engine)),
                    text_cell("the scene asks for",
                              fact.differs() ? element("strong", "differs:") + " " + html(fact.scene) : "the same"));
  return element("details.equivalence", element("summary", element("b", html(card.label)), " ", said),
                 element("table.cells", table_head({{"property"}, {"this engine"}, {"the scene asks for"}}),
                         element("tbody", rows)));
}

std::string defects_html(const std::vector<DefectRow>& defects) {
  if (defects.empty()) return "";
  std::string rows;
  for (const auto& [label, d] : defects)
    rows += element("tr", row_head(html(label)), text_cell("library", html(d.library)),
                    text_cell("upstream", html(d.upstream)), text_cell("what counts", html(d.predicate)),
                    figure_cell("hits in this run", counted(d.hits) + " of " + counted(d.asked)));
  return element("h4", "Known defects of the libraries") +
         element("table.cells",
                 table_head({{"engine"}, {"library"}, {"upstream"}, {"what counts"}, {"hits in this run", true}}),
                 element("tbody", rows));
}

}  // namespace

std::string equivalence_section(const SceneView& scene) {
  const std::vector<EngineCard> cards = cards_of(scene);
  const std::vector<DefectRow> defects = defects_of(scene);
  const std::string declared = declared_html(scene);
  if (cards.empty() && defects.empty() && declared.empty()) return "";
  std::string out;
  for (const EngineCard& card : cards) out += card_html(card);
  return element("section", element("h3", "Is it the same scene?"), out, declared, defects_html(defects));
}

}  // namespace broadside::reports
