// Engines from shared libraries and programs that the user names on the command line: --engine ./libmine.so, --engine
// 'node jolt.mjs'.
#pragma once

#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// No id: it has a slash or a blank, or ends in .so. Of a library only this file is loaded; no folders are searched.
bool is_plugin_path(std::string_view text);

// The row of the engine in that file or behind that command. A child process loads the library, or starts the program,
// and describes it: this process never runs code of it before an engine is created. Errors: no such file, the
// description crashed, hung or was refused. The row lives as long as this program; the same path gives the same row.
core::Result<const core::EngineRow*> plugin_row(std::string_view path);

// What to write after --engine for this row: its path or command for a plug-in, its id otherwise.
std::string engine_argument(const core::EngineRow& row);

}  // namespace broadside::bench
