// Makes engines of the table for this process, and refuses those that must not run in it.
#pragma once

#include <map>
#include <string>

#include "core/engine/engine.hpp"

namespace broadside::bench::python {

using GivenSettings = std::map<std::string, std::string>;

// Raises for plug-ins, for engines that cannot run here, and for engines that may abort, unless the caller passes
// may_abort.
core::Engine make_engine(const std::string& id, const GivenSettings& settings, bool may_abort);

}  // namespace broadside::bench::python
