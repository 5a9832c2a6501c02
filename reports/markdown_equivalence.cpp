// Equivalence, known defects and agreement as Markdown.
#include "reports/declared.hpp"
#include "reports/equivalence.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

std::string text(std::string_view raw) {
  return markdown(clipped(printable(raw), 300));
}

// Keys that no engine declared are left out; the page has them.
std::string declared_block(const SceneView& scene) {
  const DeclaredTable table = declared_table(scene);
  if (table.columns.empty()) return "";
  std::string out = "\n#### What engines declare about themselves\n\n| declared |";
  std::string rule = "\n| --- |";
  for (const DeclaredColumn& column : table.columns) {
    std::string labels;
    for (const std::string& label : column.labels) labels += (labels.empty() ? "" : ", ") + label;
    out += " " + text(labels) + " |";
    rule += " --- |";
  }
  out += rule + "\n";
  bool is_empty = true;
  for (std::size_t k = 0; k < table.keys.size(); ++k) {
    std::string row = "| " + text(table.keys[k]) + " |";
    bool any = false;
    for (const DeclaredColumn& column : table.columns) {
      any = any || !column.values[k].empty();
      row += " " + text(column.values[k].empty() ? undeclared_text(table.defaults[k]) : column.values[k]) + " |";
    }
    if (any) out += row + "\n";
    is_empty = is_empty && !any;
  }
  if (!is_empty) return out;
  out += "| every key |";
  for (std::size_t k = 0; k < table.columns.size(); ++k) out += " not declared |";
  return out + "\n";
}

}  // namespace

std::vector<std::string> equivalence_markdown(const SceneView& scene) {
  std::vector<std::string> blocks;
  const AgreementGrid grid = agreement_of(scene);
  if (!grid.columns.empty()) {
    std::string head = "\n#### Agreement with the exact answer\n\n| engine |";
    std::string rule = "| --- |";
    for (const std::string& column : grid.columns) {
      head += " " + text(column) + " |";
      rule += " --- |";
    }
    std::string rows;
    for (const auto& [label, texts] : grid.rows) {
      rows += "| " + text(label) + " |";
      for (const std::string& cell : texts) rows += " " + (cell.empty() ? std::string("none") : text(cell)) + " |";
      rows += "\n";
    }
    blocks.push_back(head + "\n" + rule + "\n" + rows);
  }
  std::string differences;
  for (const EngineCard& card : cards_of(scene))
    for (const core::EquivalenceFact& fact : card.facts)
      if (fact.differs())
        differences += "| " + text(card.label) + " | " + text(fact.property) + " | " + text(fact.engine) + " | " +
                       text(fact.scene) + " |\n";
  if (!differences.empty())
    blocks.push_back(
        "\n#### Where engines differ from the scene\n\n| engine | property | this engine | the scene asks for |\n| --- "
        "| --- | --- | --- |\n" +
        differences);
  if (const std::string declared = declared_block(scene); !declared.empty()) blocks.push_back(declared);
  std::string met;
  for (const auto& [label, d] : defects_of(scene))
    met += "| " + text(label) + " | " + text(d.library) + " | " + text(d.upstream) + " | " + text(d.predicate) + " | " +
           counted(d.hits) + " of " + counted(d.asked) + " |\n";
  if (!met.empty())
    blocks.push_back(
        "\n#### Known defects of the libraries\n\n| engine | library | upstream | what counts | hits |\n| --- | --- | "
        "--- | --- | ---: |\n" +
        met);
  return blocks;
}

}  // namespace broadside::reports
