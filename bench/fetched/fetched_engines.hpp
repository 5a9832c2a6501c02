// Engines that are programs of this tree over packages from npm. They are installed on demand, each with the version
// that its lock file names, and are rows like every other engine; until then a row says how to install it.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// The engines as rows of the table of engines: name, what it is, and why it is absent. The settings are those of the
// program, so they are known only when it is installed.
std::span<const core::EngineRow> fetched_engine_rows();

// "node FOLDER/reference/programs/jolt/jolt.mjs" of an installed engine; empty for others.
std::string fetched_command(std::string_view id);

// The folder of that program, where npm installed its package.
std::filesystem::path fetched_folder(std::string_view id);

// Writes the program's files and installs its package with npm, exactly as its lock file says. A second call does
// nothing. The program appears whole or not at all, because its folder gets the final name at the end. Errors: unknown
// name, no npm, no network (npm's own last line), a full disk.
core::Status fetch_engine(std::string_view id, const std::function<void(std::string_view)>& say);

}  // namespace broadside::bench
