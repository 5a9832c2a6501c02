#pragma once

#include <memory>

#include "core/engine/broad_phase.hpp"
#include "core/plugin/memory_space.hpp"
#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

std::unique_ptr<core::BroadPhase> make_plugin_broad_phase(std::shared_ptr<PluginInstance> instance,
                                                          std::shared_ptr<core::MemorySpace> space);

}  // namespace broadside::reference
