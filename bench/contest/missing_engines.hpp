// Entrants that can be installed and are not: named, and installed where somebody agrees.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contest/contest_request.hpp"

namespace broadside::bench::contest {

// What can be installed, whom to ask, and what installs one.
struct InstallPath {
  std::vector<std::string> ids;
  std::function<bool(const std::string& question)> agrees;
  std::function<core::Status(std::string_view id)> install;
};

// Ids of absent entrants that are among these, each once.
std::vector<std::string> missing_of(const std::vector<Entrant>& entrants, const std::vector<std::string>& ids);

// Asks once for all of them. How many were installed; none where nobody agrees. An engine that cannot be installed
// stays absent, with a line that says why.
std::size_t install_missing(const std::vector<Entrant>& entrants, const InstallPath& path);

}  // namespace broadside::bench::contest
