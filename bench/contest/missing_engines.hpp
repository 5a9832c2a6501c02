// Entrants that can be installed and are not: they are named, and installed if the user agrees.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contest/contest_request.hpp"

namespace broadside::bench::contest {

// Which engines can be installed, how to ask the user, and the function that installs one.
struct InstallPath {
  std::vector<std::string> ids;
  std::function<bool(const std::string& question)> agrees;
  std::function<core::Status(std::string_view id)> install;
};

// Ids of absent entrants that are among these, each once.
std::vector<std::string> missing_of(const std::vector<Entrant>& entrants, const std::vector<std::string>& ids);

// Asks once for all of them. Returns how many were installed: none if the user does not agree. An engine that cannot be
// installed stays absent, with a line that says why.
std::size_t install_missing(const std::vector<Entrant>& entrants, const InstallPath& path);

}  // namespace broadside::bench::contest
