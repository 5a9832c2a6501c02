#include "bench/contest/missing_engines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace broadside::bench::contest {
std::vector<std::string> missing_of(const std::vector<Entrant>& entrants, const std::vector<std::string>& ids) {
  std::vector<std::string> missing;
  for (const Entrant& e : entrants) {
    const std::string id = e.engine.substr(0, e.engine.find('['));
    const bool can_be = std::find(ids.begin(), ids.end(), id) != ids.end();
    if (!e.absent.empty() && can_be && std::find(missing.begin(), missing.end(), id) == missing.end())
      missing.push_back(id);
  }
  return missing;
}

std::size_t install_missing(const std::vector<Entrant>& entrants, const InstallPath& path) {
  const std::vector<std::string> ids = missing_of(entrants, path.ids);
  if (ids.empty()) return 0;
  std::string names;
  for (const std::string& id : ids) names += (names.empty() ? "" : ", ") + id;
  if (!path.agrees(fmt::format("Not installed: {}. Install {} with npm?", names, ids.size() == 1 ? "it" : "them"))) {
    fmt::print(stderr, "absent from the contest: {}; --yes installs {}\n", names, ids.size() == 1 ? "it" : "them");
    return 0;
  }
  std::size_t installed = 0;
  for (const std::string& id : ids) {
    const core::Status status = path.install(id);
    if (status)
      ++installed;
    else
      fmt::print(stderr, "absent from the contest: {}\n", status.error().line());
  }
  return installed;
}

}  // namespace broadside::bench::contest
