#include "bench/cell/cell_spec.hpp"

#include <utility>

#include "bench/cell/engine_text.hpp"
#include "bench/engines.hpp"

namespace broadside::bench {

core::Result<CellSpec> parse_cell_spec(std::string_view text) {
  auto given = parse_engine_text(text);
  // An engine that does not exist is reported before its settings are read.
  auto row = find_engine(text.substr(0, text.find('[')));
  if (!row) return row.error();
  if (!given) return given.error();
  return CellSpec{row.value(), std::move(given.value().settings)};
}

std::string label_of(const CellSpec& spec) {
  auto settings = core::Settings::parse(spec.row->id, spec.row->settings, spec.settings);
  const std::string chosen = settings ? settings.value().short_form() : "";
  return chosen.empty() ? std::string(spec.row->id) : std::string(spec.row->id) + "[" + chosen + "]";
}

bool offers(const core::EngineRow& row, std::string_view capability) {
  return row.capabilities.find(capability) != std::string_view::npos;
}

}  // namespace broadside::bench
