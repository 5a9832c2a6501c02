// An engine from outside this tree: a shared library or a program that the user named.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/plugin/memory_space.hpp"

namespace broadside::reference {

// The description that a plug-in gives of itself, without the library: safe to hold in a process that never loads it.
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

// A command of several words, a script that begins with #!, or an executable file: a program. Anything else that is
// named by a path is a library.
bool is_program(std::string_view given);

// Loads the library, or starts the program, and reads its description. Call it only in a child process: a bad library
// may crash it, and a bad program may hang.
core::Result<PluginDescription> describe_plugin(const std::string& given);

// Creates the engine. `space`: where a library wants its arrays. Settings: those of the description, by key.
core::Result<core::Engine> create_plugin_engine(const std::string& given, const core::Settings& settings,
                                                const std::shared_ptr<core::MemorySpace>& space);

}  // namespace broadside::reference
