// Candidate, confirmed and touching pairs that were lost, invented or changed, and octrees: the law of each names it.
#include <cmath>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kTallTower = "tower:cube:5";

// A frame in the middle of the recording, so that no rule about the first or the last frames finds it.
FrameRecord& behind_middle(Recording& r) {
  return r.frames[r.frames.size() / 2 + 1];
}

void lose_confirmed(FrameRecord& frame, std::size_t k) {
  frame.confirmed.erase(frame.confirmed.begin() + static_cast<std::ptrdiff_t>(k));
  if (!frame.proximity.empty()) frame.proximity.erase(frame.proximity.begin() + static_cast<std::ptrdiff_t>(k));
}

void lose_first_confirmed(FrameRecord& frame) {
  lose_confirmed(frame, 0);
}

constexpr Corruption kLostCandidates[] = {
    {"a pair lost", kTallTower, "candidate-set", [](Recording& r) { behind_middle(r).pairs.pop_back(); }},
    {"a pair lost, and the counts with it", kTallTower, "candidate-set",
     [](Recording& r) {
       FrameRecord& frame = behind_middle(r);
       frame.pairs.pop_back();
       frame.pairs_demanded = frame.pairs_raw = frame.pairs.size();
     }},
    {"a pair of boxes that are apart", "mixed", "candidate-set",
     [](Recording& r) {
       FrameRecord& frame = r.frames[0];
       frame.pairs.push_back({1, 5});
       frame.pairs_demanded = frame.pairs_raw = frame.pairs.size();
     }},
    {"the pairs of the frame before", "mixed", "candidate-set",
     [](Recording& r) {
       for (std::size_t k = 1; k < r.frames.size(); ++k)
         if (r.frames[k].pairs != r.frames[k - 1].pairs) {
           r.frames[k].pairs = r.frames[k - 1].pairs;
           return;
         }
       r.is_spoilable = false;
     }},
    {"a pair twice", kTallTower, "candidate-set",
     [](Recording& r) { behind_middle(r).pairs.push_back(behind_middle(r).pairs.back()); }},
    {"pairs in another order", kTallTower, "candidate-set",
     [](Recording& r) { std::swap(behind_middle(r).pairs.front(), behind_middle(r).pairs.back()); }},
    {"a pair of two static bodies", "pile", "candidate-set",
     [](Recording& r) {
       auto& pairs = r.frames[0].pairs;
       pairs.push_back({5, 11});
       std::sort(pairs.begin(), pairs.end());
     }},
    {"more demanded than stored", kTallTower, "capacity", [](Recording& r) { ++behind_middle(r).pairs_demanded; }},
    {"fewer demanded than stored", kTallTower, "capacity", [](Recording& r) { --behind_middle(r).pairs_demanded; }},
    {"fewer raw pairs than were left of them", kTallTower, "capacity",
     [](Recording& r) { --behind_middle(r).pairs_raw; }},
    {"no raw pairs", kTallTower, "capacity", [](Recording& r) { behind_middle(r).pairs_raw = 0; }},
};

TEST(Corruptions, OfCandidatePairs) {
  expect_rejected(kLostCandidates);
}

constexpr Corruption kLostConfirmed[] = {
    {"a confirmed pair lost in a middle frame", kTallTower, "level-agreement",
     [](Recording& r) { lose_first_confirmed(behind_middle(r)); }},
    {"a confirmed pair lost in the frame after", kTallTower, "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[behind_middle(r).step]); }},
    {"a confirmed pair lost in the last frame", kTallTower, "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames.back()); }},
    {"a confirmed pair lost in one frame of six hundred", "two-body:resting[frames=600]", "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[301]); }},
    {"a confirmed pair lost in the frame before it", "two-body:resting[frames=600]", "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[300]); }},
    {"no confirmed pairs", kTallTower, "level-agreement",
     [](Recording& r) {
       behind_middle(r).confirmed.clear();
       behind_middle(r).proximity.clear();
     }},
    {"a pair confirmed whose last-level boxes are apart", "balls", "level-agreement",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (const Pair p : frame.pairs)
           if (!std::binary_search(frame.confirmed.begin(), frame.confirmed.end(), p)) {
             const auto at = std::lower_bound(frame.confirmed.begin(), frame.confirmed.end(), p);
             frame.proximity.insert(frame.proximity.begin() + (at - frame.confirmed.begin()), core::Proximity{});
             frame.confirmed.insert(at, p);
             return;
           }
       r.is_spoilable = false;
     }},
    {"a pair confirmed twice", kTallTower, "level-agreement",
     [](Recording& r) {
       behind_middle(r).confirmed.push_back(behind_middle(r).confirmed.back());
       behind_middle(r).proximity.push_back(behind_middle(r).proximity.back());
     }},
    {"a pair that is no candidate confirmed", "mixed", "level-agreement",
     [](Recording& r) {
       r.frames[0].confirmed.push_back({1, 5});
       r.frames[0].proximity.emplace_back();
     }},
};

TEST(Corruptions, OfConfirmedPairs) {
  expect_rejected(kLostConfirmed);
}

constexpr Corruption kProximity[] = {
    {"a distance a thousandth too long", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 *= 1.002F; }},
    {"a distance a thousandth too short", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 *= 0.998F; }},
    {"a touching pair told apart", "mixed", "proximity-bound",
     [](Recording& r) { *bench::touch_of(r).proximity = {}; }},
    {"another vertex", "mixed", "proximity-bound", [](Recording& r) { bench::touch_of(r).proximity->vertex_a ^= 1U; }},
    {"a vertex pair farther away", "mixed", "proximity-bound", [](Recording& r) { bench::retarget(r, 0.2, 0.284); }},
    {"no distances in one frame", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).frame->proximity.clear(); }},
    {"a distance that is no number", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 = NAN; }},
    {"half of theta in the scene", "mixed", "proximity-bound",
     [](Recording& r) {
       r.header.scene.parameters.theta_m = 0.5F * std::sqrt(bench::touch_of(r).proximity->squared_distance_m2);
     }},
};

TEST(Corruptions, OfVertexProximity) {
  expect_rejected(kProximity);
}

constexpr const char* kSpoiledOctree = "errata:E2 broad=octree";

constexpr Corruption kSpoiledOctrees[] = {
    {"a node too few", kSpoiledOctree, "octree-invariants", [](Recording& r) { r.frames[0].octree_nodes.pop_back(); }},
    {"a cell a little too large", kSpoiledOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[3].box.max.x += 1e-3F; }},
    {"a body one level too high", kSpoiledOctree, "octree-invariants",
     [](Recording& r) {
       for (std::uint32_t& node : r.frames[0].octree_node_of_body)
         if (node != 0) {
           node = r.frames[0].octree_nodes[node].parent;
           return;
         }
       r.is_spoilable = false;
     }},
    {"a body in another cell", kSpoiledOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_node_of_body[0] = 72 - r.frames[0].octree_node_of_body[0]; }},
    {"a node with another parent", kSpoiledOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[20].parent = 8; }},
    {"a vertex in another leaf", kSpoiledOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].leaf_of_vertex[0] = 63 - r.frames[0].leaf_of_vertex[0]; }},
    {"a loose box of a leaf", kSpoiledOctree, "octree-invariants",
     [](Recording& r) {
       for (std::size_t k = 9; k < 73; ++k)
         if (!core::is_empty(r.frames[0].body_octree_boxes[k])) {
           r.frames[0].body_octree_boxes[k].max.y += 1e-6F;
           return;
         }
       r.is_spoilable = false;
     }},
};

TEST(Corruptions, OfOctrees) {
  expect_rejected(kSpoiledOctrees);
}

}  // namespace
}  // namespace broadside::tests
