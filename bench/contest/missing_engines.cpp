#include "bench/contest/missing_engines.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "bench/fetched/fetched_engines.hpp"

namespace broadside::bench::contest {
namespace {

bool ask_terminal(const std::string& question) {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDERR_FILENO) == 0) return false;
  fmt::print(stderr, "{} [y/N] ", question);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace

std::vector<std::string> fetchable(const std::vector<Entrant>& entrants) {
  const auto rows = fetched_engine_rows();
  std::vector<std::string> ids;
  for (const Entrant& e : entrants) {
    const std::string id = e.engine.substr(0, e.engine.find('['));
    const bool is_fetched =
        std::any_of(rows.begin(), rows.end(), [&id](const core::EngineRow& row) { return row.id == id; });
    if (!e.absent.empty() && is_fetched && std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

std::size_t install_missing(const std::vector<Entrant>& entrants, const InstallPath& path) {
  const std::vector<std::string> ids = fetchable(entrants);
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

InstallPath usual_path(bool yes) {
  const auto say = [](std::string_view step) { fmt::print(stderr, "{}\n", step); };
  return {[yes](const std::string& question) { return yes || ask_terminal(question); },
          [say](std::string_view id) {
            fmt::print(stderr, "{}: ", id);
            return fetch_engine(id, say);
          }};
}

}  // namespace broadside::bench::contest
