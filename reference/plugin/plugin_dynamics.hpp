#pragma once

#include <memory>

#include "core/engine/dynamics.hpp"
#include "core/plugin/memory_space.hpp"
#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

std::unique_ptr<core::Dynamics> make_plugin_dynamics(std::shared_ptr<PluginInstance> instance,
                                                     std::shared_ptr<core::MemorySpace> space);

}  // namespace broadside::reference
