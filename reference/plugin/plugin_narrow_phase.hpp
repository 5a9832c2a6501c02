#pragma once

#include <memory>

#include "core/engine/narrow_phase.hpp"
#include "core/plugin/memory_space.hpp"
#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

std::unique_ptr<core::NarrowPhase> make_plugin_narrow_phase(std::shared_ptr<PluginInstance> instance,
                                                            std::shared_ptr<core::MemorySpace> space);

}  // namespace broadside::reference
