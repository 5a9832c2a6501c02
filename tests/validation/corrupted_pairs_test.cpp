// Candidate, confirmed and touching pairs that were lost, invented or changed, and octrees: the law of each names it.
#include <cmath>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kTall = "tower:cube:5";

// A frame in the middle of the recording, so that no rule about the first or the last frames finds it.
FrameRecord& middle(Recording& r) {
  return r.frames[r.frames.size() / 2 + 1];
}

void lose_confirmed(FrameRecord& frame, std::size_t k) {
  frame.confirmed.erase(frame.confirmed.begin() + static_cast<std::ptrdiff_t>(k));
  if (!frame.proximity.empty()) frame.proximity.erase(frame.proximity.begin() + static_cast<std::ptrdiff_t>(k));
}

void lose_first_confirmed(FrameRecord& frame) {
  lose_confirmed(frame, 0);
}

constexpr Corruption kCandidates[] = {
    {"a pair lost", kTall, "candidate-set", [](Recording& r) { middle(r).pairs.pop_back(); }},
    {"a pair lost, and the counts with it", kTall, "candidate-set",
     [](Recording& r) {
       FrameRecord& frame = middle(r);
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
    {"a pair twice", kTall, "candidate-set", [](Recording& r) { middle(r).pairs.push_back(middle(r).pairs.back()); }},
    {"pairs in another order", kTall, "candidate-set",
     [](Recording& r) { std::swap(middle(r).pairs.front(), middle(r).pairs.back()); }},
    {"a pair of two static bodies", "pile", "candidate-set",
     [](Recording& r) {
       auto& pairs = r.frames[0].pairs;
       pairs.push_back({5, 11});
       std::sort(pairs.begin(), pairs.end());
     }},
    {"more demanded than stored", kTall, "capacity", [](Recording& r) { ++middle(r).pairs_demanded; }},
    {"fewer demanded than stored", kTall, "capacity", [](Recording& r) { --middle(r).pairs_demanded; }},
    {"fewer raw pairs than were left of them", kTall, "capacity", [](Recording& r) { --middle(r).pairs_raw; }},
    {"no raw pairs", kTall, "capacity", [](Recording& r) { middle(r).pairs_raw = 0; }},
};

TEST(Corruptions, OfCandidatePairs) {
  expect_rejected(kCandidates);
}

constexpr Corruption kConfirmed[] = {
    {"a confirmed pair lost in a middle frame", kTall, "level-agreement",
     [](Recording& r) { lose_first_confirmed(middle(r)); }},
    {"a confirmed pair lost in the frame after", kTall, "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[middle(r).step]); }},
    {"a confirmed pair lost in the last frame", kTall, "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames.back()); }},
    {"a confirmed pair lost in one frame of six hundred", "two-body:resting[frames=600]", "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[301]); }},
    {"a confirmed pair lost in the frame before it", "two-body:resting[frames=600]", "level-agreement",
     [](Recording& r) { lose_first_confirmed(r.frames[300]); }},
    {"no confirmed pairs", kTall, "level-agreement",
     [](Recording& r) {
       middle(r).confirmed.clear();
       middle(r).proximity.clear();
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
    {"a pair confirmed twice", kTall, "level-agreement",
     [](Recording& r) {
       middle(r).confirmed.push_back(middle(r).confirmed.back());
       middle(r).proximity.push_back(middle(r).proximity.back());
     }},
    {"a pair that is no candidate confirmed", "mixed", "level-agreement",
     [](Recording& r) {
       r.frames[0].confirmed.push_back({1, 5});
       r.frames[0].proximity.emplace_back();
     }},
};

TEST(Corruptions, OfConfirmedPairs) {
  expect_rejected(kConfirmed);
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

constexpr const char* kOctree = "errata:E2 broad=octree";

constexpr Corruption kOctrees[] = {
    {"a node too few", kOctree, "octree-invariants", [](Recording& r) { r.frames[0].octree_nodes.pop_back(); }},
    {"a cell a little too large", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[3].box.max.x += 1e-3F; }},
    {"a body one level too high", kOctree, "octree-invariants",
     [](Recording& r) {
       for (std::uint32_t& node : r.frames[0].octree_node_of_body)
         if (node != 0) {
           node = r.frames[0].octree_nodes[node].parent;
           return;
         }
       r.is_spoilable = false;
     }},
    {"a body in another cell", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_node_of_body[0] = 72 - r.frames[0].octree_node_of_body[0]; }},
    {"a node with another parent", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[20].parent = 8; }},
    {"a vertex in another leaf", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].leaf_of_vertex[0] = 63 - r.frames[0].leaf_of_vertex[0]; }},
    {"a loose box of a leaf", kOctree, "octree-invariants",
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
  expect_rejected(kOctrees);
}

}  // namespace
}  // namespace broadside::tests
