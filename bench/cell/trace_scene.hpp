// A recorded trace as the source of a scene.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

// Whether a command's argument names a trace and not a scene; decided by its ending.
bool is_trace_file(std::string_view spec);

// The scene that a trace contains, whatever program recorded it. Errors: those of the trace's reader.
core::Result<core::Scene> scene_of_trace(const std::filesystem::path& trace);

}  // namespace broadside::bench
