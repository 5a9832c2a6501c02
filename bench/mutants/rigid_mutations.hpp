// The part of the mutation score that is about the laws of mechanics: plain-rigid and octree-cpu, wrong engines made of
// them, and spoiled recordings of plain-rigid.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/mutants/mutation_score.hpp"
#include "core/result.hpp"

namespace broadside::bench {

std::vector<std::string> rigid_mutation_names();

// Runs the mutations that are wanted, and gives each row to `finish`, without is_caught.
core::Status run_rigid_mutations(const std::function<bool(const std::string& name)>& is_wanted,
                                 const std::function<void(MutationRow)>& finish);

// Runs both sound engines on every scene of the mutants, and on random scenes at three step sizes. A law that rejects
// one of them is a false alarm.
core::Status judge_sound_rigid(std::uint32_t random_scenes, MutationScore& score, const std::function<void()>& tick);

// How many times judge_sound_rigid ticks.
std::uint64_t sound_rigid_ticks(std::uint32_t random_scenes);

}  // namespace broadside::bench
