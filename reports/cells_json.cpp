#include "reports/cells_json.hpp"

#include <nlohmann/json.hpp>

#include "reports/figures.hpp"

namespace broadside::reports {

std::string cells_json(const std::vector<core::Cell>& cells) {
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson all = OrderedJson::array();
  for (const core::Cell& cell : cells) {
    OrderedJson one{{"scene", cell.stamp.scene_name},
                    {"engine", cell.stamp.engine},
                    {"settings", cell.stamp.settings_short},
                    {"label", cell.stamp.label()},
                    {"state", core::cell_state_word(cell.state)},
                    {"reason", cell.reason},
                    {"frames", cell.frames},
                    {"wall_s", cell.wall_s},
                    {"trace", cell.trace_file}};
    if (!cell.digests.empty()) {
      one["last_step"] = cell.digests.rbegin()->first;
      one["last_digest"] = hexadecimal(cell.digests.rbegin()->second);
    }
    one["counters"] = OrderedJson::object();
    for (const auto& [name, count] : cell.counters) one["counters"][name] = count;
    all.push_back(std::move(one));
  }
  const OrderedJson document{{"format", "broadside-run"}, {"version", 1}, {"cells", std::move(all)}};
  return document.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace broadside::reports
