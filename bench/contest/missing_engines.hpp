// Entrants that are packages of npm and not installed: named, and installed where somebody agrees.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contest/contest_request.hpp"

namespace broadside::bench::contest {

// Whom to ask, and what installs one; the program's own are the terminal and fetch_engine.
struct InstallPath {
  std::function<bool(const std::string& question)> agrees;
  std::function<core::Status(std::string_view id)> install;
};

// Ids of absent entrants that can be fetched, each once.
std::vector<std::string> fetchable(const std::vector<Entrant>& entrants);

// Asks once for all of them. How many were installed; none where nobody agrees. An engine that cannot be installed
// stays absent, with a line that says why.
std::size_t install_missing(const std::vector<Entrant>& entrants, const InstallPath& path);

// yes: agrees to everything. Otherwise a question on the terminal, and no where there is none.
InstallPath usual_path(bool yes);

}  // namespace broadside::bench::contest
