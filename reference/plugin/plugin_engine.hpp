// An engine from a shared library that the user named.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/plugin/memory_space.hpp"

namespace broadside::reference {

// What a plug-in says about itself, without the library: safe to hold in a process that never loads it.
struct PluginDescription {
  struct Setting {
    std::string key;
    std::uint64_t default_value = 0;
    std::string what;
  };
  std::string id;
  std::string capabilities;
  std::string build;
  std::string what;
  bool on_device = false;
  std::vector<Setting> settings;
};

// Loads the library and reads its description. Call it only in a child process: a bad library may crash it.
core::Result<PluginDescription> describe_plugin(const std::filesystem::path& file);

// The engine itself. `space` is where the plug-in wants its arrays. Settings: those of the description, by key.
core::Result<core::Engine> create_plugin_engine(const std::filesystem::path& file, const core::Settings& settings,
                                                std::shared_ptr<core::MemorySpace> space);

}  // namespace broadside::reference
