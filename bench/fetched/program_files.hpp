// The sources of reference/programs and of their client, compiled in: fetch-engine writes them beside the package that
// they need, under the same paths, so that an installed program needs no tree.
#pragma once

#include <span>
#include <string_view>

namespace broadside::bench {

struct ProgramFile {
  std::string_view path;  // from the root of the tree: "reference/programs/jolt/jolt.mjs"
  std::string_view text;
};

std::span<const ProgramFile> program_files();

}  // namespace broadside::bench
