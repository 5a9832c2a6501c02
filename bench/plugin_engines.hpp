// Engines from shared libraries and programs that the user names on the command line: --engine ./libmine.so, --engine
// 'node jolt.mjs'.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// Whether the text is no id: it has a slash or a blank, or ends in .so. Of a library only this file is loaded; no
// folders are searched.
bool is_plugin_path(std::string_view text);

// The row of the engine in that file or behind that command. A child process loads the library, or starts the program,
// and describes it, so this process runs no code of it before an engine is created. Errors: no such file; the
// description crashed, hung or was refused. The row lives as long as this program; the same path gives the same row.
// `fetched_folder`: the folder of an installed program, where its description is kept for later calls.
core::Result<const core::EngineRow*> plugin_row(std::string_view path,
                                                const std::filesystem::path& fetched_folder = {});

// A digest of the files that a plug-in's engine is made of, as in its build line ("content 1234..."), so that a library
// that was built again is another engine. Empty for engines of the table.
std::string plugin_content(const core::EngineRow& row);

// What to write after --engine for this row: its path or command for a plug-in, its id otherwise.
std::string engine_argument(const core::EngineRow& row);

}  // namespace broadside::bench
