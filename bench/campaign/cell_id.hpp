// A cell's id in a manifest: 16 hexadecimal digits that hash the cell's work, its scene and this build.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "bench/campaign/manifest.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {

// A hash that is the same on every machine.
std::uint64_t hashed(std::string_view text);

// The hash as 16 hexadecimal digits.
std::string id_of(std::string_view text);

// The cell of this work with its id; no other cell takes turns with it. `beside`: further facts that distinguish cells
// of the same work. Errors: an engine or setting that does not exist, in the work or its baseline.
core::Result<ManifestCell> identified(const CellWork& work, std::uint64_t scene_digest, const std::string& beside);

}  // namespace broadside::bench::campaign
