// Subjects of the shared tests for engines that no test lists with settings and known defects of its own.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"

namespace broadside::tests {

// Appends each engine of reference/engines.inc that offers the capability ("broad", "narrow", "dynamics"), can run here
// and is not in the list yet, with default settings. Its name in the test is its id with _ for -.
template <typename Subject>
std::vector<Subject> with_unlisted(std::vector<Subject> subjects, std::string_view capability) {
  for (const reference::EngineRowFunction function : reference::engine_rows()) {
    const core::EngineRow row = function();
    const bool is_listed =
        std::any_of(subjects.begin(), subjects.end(), [&](const Subject& s) { return s.row().id == row.id; });
    const bool is_absent = row.absent != nullptr && !row.absent().empty();
    if (is_listed || is_absent || row.capabilities.find(capability) == std::string_view::npos) continue;
    Subject subject;
    subject.name = std::string(row.id);
    std::replace(subject.name.begin(), subject.name.end(), '-', '_');
    subject.row = function;
    subjects.push_back(subject);
  }
  return subjects;
}

}  // namespace broadside::tests
