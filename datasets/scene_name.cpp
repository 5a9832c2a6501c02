#include "datasets/scene_name.hpp"

#include <algorithm>

namespace broadside::datasets {

core::Result<SceneName> parse_scene_name(std::string_view text) {
  SceneName name;
  name.text = text;
  const std::size_t bracket = text.find('[');
  name.plain = text.substr(0, bracket);
  for (std::string_view rest = name.plain;;) {
    const std::size_t colon = rest.find(':');
    name.parts.emplace_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (bracket == std::string_view::npos) return name;
  const core::Error malformed{"its options cannot be read", "scene '" + name.text + "'",
                              "write them as NAME[key=value,key=value]"};
  if (!text.ends_with(']')) return malformed;
  std::string_view inside = text.substr(bracket + 1, text.size() - bracket - 2);
  while (!inside.empty()) {
    const std::string_view item = inside.substr(0, inside.find(','));
    inside.remove_prefix(std::min(inside.size(), item.size() + 1));
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) return malformed;
    if (!name.options.emplace(item.substr(0, equals), item.substr(equals + 1)).second)
      return core::Error{"'" + std::string(item.substr(0, equals)) + "' is given twice", "scene '" + name.text + "'",
                         "give it once"};
  }
  return name;
}

}  // namespace broadside::datasets
