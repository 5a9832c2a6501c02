#pragma once

#include <memory>

#include "core/engine/dynamics.hpp"
#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

// The dynamics of an engine of version 2 of the interface.
std::unique_ptr<core::Dynamics> make_plugin_dynamics2(std::shared_ptr<PluginInstance> instance);

}  // namespace broadside::reference
