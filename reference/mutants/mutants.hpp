// Wrong engines: the pipeline with one stage replaced, and the validator that must reject it.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "core/engine/dynamics.hpp"
#include "reference/mutants/stages.hpp"

namespace broadside::reference {

// How a mutant is exposed: by its run alone, by a second run of itself, or by its run on a transformed scene.
enum class Showing { kAlone, kSecondRun, kMirrored, kScaled, kRenumbered };

struct Mutant {
  std::string_view name;       // "skips-first-child"
  std::string_view what;       // what is wrong, in a few words
  std::string_view validator;  // meant for
  std::string_view scene;      // where it shows: a specimen or a built-in scene
  Stages stages;
  Showing showing = Showing::kAlone;
};

// Five tables, by what is wrong.
std::span<const Mutant> pair_mutants();  // candidates, levels, vertices
std::span<const Mutant> octree_mutants();
std::span<const Mutant> contact_mutants();   // geometry, order, position correction
std::span<const Mutant> velocity_mutants();  // impulses, friction, cap
std::span<const Mutant> state_mutants();     // integration, rounding, lags, runs that differ

std::unique_ptr<core::Dynamics> make_mutant(const Mutant& mutant, std::uint64_t run);

}  // namespace broadside::reference
