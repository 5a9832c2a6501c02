// Two rows per engine: as its library ships, and as its manual recommends. Each with its source.
#pragma once

#include <span>
#include <string_view>

namespace broadside::bench::contest {

struct Tuning {
  std::string_view as_shipped;   // the entrant's label
  std::string_view recommended;  // the label of the second row; empty where it would be the first once more
  std::string_view what;         // what the manual recommends
  std::string_view source;
};

// In the order of the page. The same settings for all scenes.
std::span<const Tuning> tunings();

// Whether this label is the second row of an engine: it runs at the scenes' own steps alone.
bool is_recommended(std::string_view label);

}  // namespace broadside::bench::contest
