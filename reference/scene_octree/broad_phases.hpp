// The candidate's own broad phases behind core's interface: `broad=tree` and `broad=octree`.
#pragma once

#include <memory>

#include "core/engine/broad_phase.hpp"
#include "core/math/box.hpp"
#include "core/method/scene_octree.hpp"
#include "core/variant.hpp"

namespace broadside::reference {

// threads: 0 = work in the caller's oneTBB arena (all cores where there is none); otherwise in an arena of its own with
// that many. The pairs are the same bits either way. Boxes that are not finite, or have min > max, are refused.

// The default: a packed octree per size class.
std::unique_ptr<core::BroadPhase> make_tree_broad_phase(int threads = 0);

// The same, for boxes that move little: candidates are kept between frames (kept_pairs.hpp). Exact in every frame.
std::unique_ptr<core::BroadPhase> make_kept_broad_phase(int threads = 0);

// P-Alg 1 and 2. domain: the root cell; an empty box stands for the bounds of the boxes at load. depth: levels below
// the root. variant: printed-E2 and printed-E7 search as printed, all others soundly.
std::unique_ptr<core::BroadPhase> make_scene_octree_broad_phase(const core::Box& domain,
                                                                int depth = core::kSceneOctreeDepth,
                                                                core::Variant variant = core::Variant::kSound,
                                                                int threads = 0);

}  // namespace broadside::reference
