// Cell notes that have a section of their own: how the engine's world differs from the scene, which known defects of
// libraries occurred, and how far narrow phases agree.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/engine/equivalence.hpp"
#include "reports/scene_view.hpp"

namespace broadside::reports {

// Whether notes with this key are printed in this section and nowhere else.
bool is_equivalence_note(std::string_view key);

struct EngineCard {
  std::string label;
  core::EquivalenceCard facts;

  [[nodiscard]] std::uint64_t differences() const;
};

// The cards of the scene's cells; cells without a card are left out.
std::vector<EngineCard> cards_of(const SceneView& scene);

struct DefectRow {
  std::string label;
  core::DefectHits defect;
};

// Most hits first, then in the order of the cells.
std::vector<DefectRow> defects_of(const SceneView& scene);

struct AgreementGrid {
  std::vector<std::string> columns;  // "deep", "shallow", ..., "thin plate"
  // Label and one text per column, empty where the cell has none.
  std::vector<std::pair<std::string, std::vector<std::string>>> rows;
};

AgreementGrid agreement_of(const SceneView& scene);

// A histogram of errors by powers of ten: bin 0 counts errors below 10^lowest_power, the last bin those of
// 10^(lowest_power + bins - 2) or more.
struct AgreementHistograms {
  std::string title;
  std::string unit;
  int lowest_power = 0;
  std::size_t bins = 0;
  std::vector<std::pair<std::string, std::vector<double>>> rows = {};  // label, counts
};
// The histograms "distance" and "normal"; a histogram that no cell has is left out.
std::vector<std::pair<std::string, AgreementHistograms>> agreement_histograms_of(const SceneView& scene);

// Cards, declarations and defects as escaped HTML; empty when no cell of the scene has any of these.
std::string equivalence_section(const SceneView& scene);

// Escaped Markdown blocks: only the differences, then declarations, defects that occurred, and the table of agreement.
std::vector<std::string> equivalence_markdown(const SceneView& scene);

}  // namespace broadside::reports
