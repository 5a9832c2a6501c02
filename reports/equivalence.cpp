#include "reports/equivalence.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "reports/escape.hpp"
#include "reports/wording.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kAgreement = "agreement: ";
// "agreement histogram: distance, m, from -8" -> "0 12 300 0 0 0 0 1".
constexpr std::string_view kHistogram = "agreement histogram: ";

}  // namespace

bool is_equivalence_note(std::string_view key) {
  return core::equivalence_of_note(key, "").has_value() || core::defect_of_note(key, "0 of 0").has_value() ||
         key.starts_with(kAgreement) || key.starts_with(kHistogram);
}

std::uint64_t EngineCard::differences() const {
  return static_cast<std::uint64_t>(
      std::count_if(facts.begin(), facts.end(), [](const core::EquivalenceFact& f) { return f.differs(); }));
}

std::vector<EngineCard> cards_of(const SceneView& scene) {
  std::vector<EngineCard> cards;
  for (const TraceView& trace : scene.traces) {
    if (trace.cell == nullptr) continue;
    EngineCard card{trace.label, {}};
    for (const auto& [key, text] : trace.cell->notes)
      if (auto fact = core::equivalence_of_note(key, text)) card.facts.push_back(std::move(*fact));
    if (!card.facts.empty()) cards.push_back(std::move(card));
  }
  return cards;
}

std::vector<DefectRow> defects_of(const SceneView& scene) {
  std::vector<DefectRow> rows;
  for (const TraceView& trace : scene.traces)
    if (trace.cell != nullptr)
      for (const auto& [key, text] : trace.cell->notes)
        if (auto defect = core::defect_of_note(key, text)) rows.push_back({trace.label, std::move(*defect)});
  std::stable_sort(rows.begin(), rows.end(),
                   [](const DefectRow& a, const DefectRow& b) { return a.defect.hits > b.defect.hits; });
  return rows;
}

// Keys are "agreement: s0 deep": the first word orders the columns.
AgreementGrid agreement_of(const SceneView& scene) {
  std::set<std::string> keys;
  for (const TraceView& trace : scene.traces)
    if (trace.cell != nullptr)
      for (const auto& [key, text] : trace.cell->notes)
        if (key.starts_with(kAgreement)) keys.insert(key);
  AgreementGrid grid;
  for (const std::string& key : keys) {
    const std::size_t space = key.find(' ', kAgreement.size());
    grid.columns.push_back(space == std::string::npos ? key : key.substr(space + 1));
  }
  for (const TraceView& trace : scene.traces) {
    if (trace.cell == nullptr || keys.empty()) continue;
    std::vector<std::string> texts;
    for (const std::string& key : keys) {
      const auto found = trace.cell->notes.find(key);
      texts.push_back(found == trace.cell->notes.end() ? "" : found->second);
    }
    grid.rows.emplace_back(trace.label, std::move(texts));
  }
  return grid;
}

std::vector<std::pair<std::string, AgreementHistograms>> agreement_histograms_of(const SceneView& scene) {
  std::vector<std::pair<std::string, AgreementHistograms>> all{{"distance", {"Distance and depth, off by", "m"}},
                                                               {"normal", {"Normal, off by", "rad"}}};
  for (auto& [what, histograms] : all) {
    const std::string start = std::string(kHistogram) + what + ", " + histograms.unit + ", from ";
    for (const TraceView& trace : scene.traces) {
      if (trace.cell == nullptr) continue;
      for (const auto& [key, text] : trace.cell->notes) {
        if (!key.starts_with(start)) continue;
        histograms.lowest_power = std::atoi(key.c_str() + start.size());
        std::istringstream in(text);
        std::vector<double> counts;
        for (double count = 0.0; in >> count;) counts.push_back(count);
        histograms.bins = std::max(histograms.bins, counts.size());
        histograms.rows.emplace_back(trace.label, std::move(counts));
      }
    }
  }
  std::erase_if(all, [](const auto& one) { return one.second.rows.empty(); });
  return all;
}

}  // namespace broadside::reports
