#include "bench/cell/cell_spec.hpp"

#include <algorithm>

#include "bench/engines.hpp"

namespace broadside::bench {

core::Result<CellSpec> parse_cell_spec(std::string_view text) {
  CellSpec spec;
  const auto bracket = text.find('[');
  auto row = find_engine(text.substr(0, bracket));
  if (!row) return row.error();
  spec.row = row.value();
  if (bracket == std::string_view::npos) return spec;
  const core::Error malformed{"cannot read '" + std::string(text) + "'", "--engine",
                              "write it as ENGINE or ENGINE[key=value,key=value]"};
  if (!text.ends_with(']')) return malformed;
  std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
  while (!inside.empty()) {
    const std::string_view item = inside.substr(0, inside.find(','));
    inside.remove_prefix(std::min(inside.size(), item.size() + 1));
    const auto equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) return malformed;
    spec.settings[std::string(item.substr(0, equals))] = item.substr(equals + 1);
  }
  return spec;
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
