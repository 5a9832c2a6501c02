// An engine that is a program, as the source of a function table whose functions exchange messages with it:
// core/plugin/PROGRAMS.md.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "reference/plugin/plugin_source.hpp"

namespace broadside::reference {

// Starts the program and asks for its description. Call it only in a child process with a time limit: a program may
// hang. `command` is the text after --engine. Errors: the program cannot be started, ends, or answers something else.
core::Result<std::shared_ptr<const PluginSource>> open_program(std::string_view command);

}  // namespace broadside::reference
