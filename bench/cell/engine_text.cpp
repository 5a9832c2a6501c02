#include "bench/cell/engine_text.hpp"

#include <algorithm>

namespace broadside::bench {

core::Result<EngineText> parse_engine_text(std::string_view text) {
  EngineText out;
  const auto bracket = text.find('[');
  out.id = text.substr(0, bracket);
  if (bracket == std::string_view::npos) return out;
  const core::Error malformed{"cannot read '" + std::string(text) + "'", "--engine",
                              "write it as ENGINE or ENGINE[key=value,key=value]"};
  if (!text.ends_with(']')) return malformed;
  std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
  while (!inside.empty()) {
    const std::string_view item = inside.substr(0, inside.find(','));
    inside.remove_prefix(std::min(inside.size(), item.size() + 1));
    const auto equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) return malformed;
    out.settings[std::string(item.substr(0, equals))] = item.substr(equals + 1);
  }
  return out;
}

}  // namespace broadside::bench
