// Equivalence cards and known defects on the page.
#include "reports/declared.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"

namespace broadside::reports {
namespace {

std::string card_html(const EngineCard& card) {
  const std::uint64_t differences = card.differences();
  std::string out = "<details class=\"equivalence\"><summary><b>" + html(card.label) + "</b> " +
                    (differences == 0 ? std::string("nothing differs from the scene")
                                      : counted(differences, "difference") + " from the scene") +
                    "</summary><table class=\"cells\"><thead><tr><th scope=\"col\">property</th><th scope=\"col\">this "
                    "engine</th><th scope=\"col\">the scene asks for</th></tr></thead><tbody>";
  for (const core::EquivalenceFact& fact : card.facts)
    out += "<tr" + std::string(fact.differs() ? " class=\"differs\"" : "") + "><th scope=\"row\">" +
           html(fact.property) + "</th><td data-name=\"this engine\">" + html(fact.engine) +
           "</td><td data-name=\"the scene asks for\">" +
           (fact.differs() ? "<strong>differs:</strong> " + html(fact.scene) : std::string("the same")) + "</td></tr>";
  return out + "</tbody></table></details>";
}

std::string defects_html(const std::vector<DefectRow>& rows) {
  if (rows.empty()) return "";
  std::string out =
      "<h4>Known defects of the libraries</h4><table class=\"cells\"><thead><tr><th scope=\"col\">engine</th><th "
      "scope=\"col\">library</th><th scope=\"col\">upstream</th><th scope=\"col\">what counts</th><th scope=\"col\" "
      "class=\"figure\">hits in this run</th></tr></thead><tbody>";
  for (const auto& [label, d] : rows)
    out += "<tr><th scope=\"row\">" + html(label) + "</th><td data-name=\"library\">" + html(d.library) +
           "</td><td data-name=\"upstream\">" + html(d.upstream) + "</td><td data-name=\"what counts\">" +
           html(d.predicate) + "</td><td class=\"figure\" data-name=\"hits in this run\">" + counted(d.hits) + " of " +
           counted(d.asked) + "</td></tr>";
  return out + "</tbody></table>";
}

}  // namespace

std::string equivalence_section(const SceneView& scene) {
  const std::vector<EngineCard> cards = cards_of(scene);
  const std::vector<DefectRow> defects = defects_of(scene);
  const std::string declared = declared_html(scene);
  if (cards.empty() && defects.empty() && declared.empty()) return "";
  std::string out = "<section><h3>Is it the same scene?</h3>";
  for (const EngineCard& card : cards) out += card_html(card);
  return out + declared + defects_html(defects) + "</section>";
}

}  // namespace broadside::reports
