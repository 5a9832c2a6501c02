// Lists of pairs, touching vertices and octrees that do not belong to the frame in which they are recorded.
#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kTall = "tower:cube:5";
constexpr const char* kOctree = "errata:E2 broad=octree";

void count(FrameRecord& frame) {
  frame.pairs_demanded = frame.pairs_raw = frame.pairs.size();
}

// Two neighboring frames whose lists differ.
template <typename List>
std::pair<FrameRecord*, FrameRecord*> where_changed(Recording& r, List FrameRecord::*list) {
  for (std::size_t k = 1; k < r.frames.size(); ++k)
    if (r.frames[k].*list != r.frames[k - 1].*list) return {&r.frames[k - 1], &r.frames[k]};
  r.is_spoilable = false;
  return {&r.frames[0], &r.frames[1]};
}

// Two touching pairs of one frame.
std::pair<core::Proximity*, core::Proximity*> two_touches(Recording& r) {
  for (FrameRecord& frame : r.frames) {
    core::Proximity* first = nullptr;
    for (core::Proximity& p : frame.proximity) {
      if (!p.is_touching()) continue;
      if (first != nullptr) return {first, &p};
      first = &p;
    }
  }
  r.is_spoilable = false;
  r.frames[0].proximity.resize(2);
  return {&r.frames[0].proximity[0], &r.frames[0].proximity[1]};
}

constexpr Corruption kCandidates[] = {
    {"the pairs of the frame after", "mixed", "candidate-set",
     [](Recording& r) {
       const auto [before, after] = where_changed(r, &FrameRecord::pairs);
       before->pairs = after->pairs;
       count(*before);
     }},
    {"no pairs in any frame", kTall, "candidate-set",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames) {
         frame.pairs.clear();
         count(frame);
       }
     }},
    {"every pair there is", "mixed", "candidate-set",
     [](Recording& r) {
       FrameRecord& frame = r.frames[4];
       frame.pairs.clear();
       for (std::uint32_t i = 0; i < 6; ++i)
         for (std::uint32_t j = i + 1; j < 6; ++j) frame.pairs.push_back({i, j});
       count(frame);
     }},
    {"a pair lost in the first frame", kTall, "candidate-set",
     [](Recording& r) {
       r.frames.front().pairs.pop_back();
       count(r.frames.front());
     }},
    {"a pair lost in the last frame", kTall, "candidate-set",
     [](Recording& r) {
       r.frames.back().pairs.pop_back();
       count(r.frames.back());
     }},
    {"a pair with a neighbor's number", kTall, "candidate-set", [](Recording& r) { ++r.frames[3].pairs.back().j; }},
    {"more demanded than there are in 64 bits", kTall, "capacity",
     [](Recording& r) { r.frames[3].pairs_demanded = ~std::uint64_t{0}; }},
};

TEST(Contradictions, OfCandidatePairs) {
  expect_rejected(kCandidates);
}

constexpr Corruption kConfirmed[] = {
    {"the confirmed pairs of the frame before", "balls", "level-agreement",
     [](Recording& r) {
       const auto [before, after] = where_changed(r, &FrameRecord::confirmed);
       after->confirmed = before->confirmed;
       after->proximity.resize(after->confirmed.size());
     }},
    {"all candidates confirmed", "balls", "level-agreement",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames) {
         if (frame.confirmed == frame.pairs) continue;
         frame.confirmed = frame.pairs;
         frame.proximity.resize(frame.confirmed.size());
         return;
       }
       r.is_spoilable = false;
     }},
    {"two confirmed pairs exchanged", kTall, "level-agreement",
     [](Recording& r) {
       std::swap(r.frames[5].confirmed[0], r.frames[5].confirmed[1]);
       std::swap(r.frames[5].proximity[0], r.frames[5].proximity[1]);
     }},
    {"levels of another setting", "balls", "level-agreement",
     [](Recording& r) {
       std::string& settings = r.header.stamp.settings;
       settings.replace(settings.find("levels=C"), 8, "levels=flat");
     }},
    {"a confirmed pair with a body that does not exist", "mixed", "level-agreement",
     [](Recording& r) {
       r.frames[0].confirmed.push_back({5, 99});
       r.frames[0].proximity.emplace_back();
     }},
};

TEST(Contradictions, OfConfirmedPairs) {
  expect_rejected(kConfirmed);
}

constexpr Corruption kVertices[] = {
    {"distances of two pairs exchanged", "pile", "proximity-bound",
     [](Recording& r) {
       const auto [p, q] = two_touches(r);
       std::swap(*p, *q);
     }},
    {"a distance of zero", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 = 0.0F; }},
    {"a distance below zero", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 *= -1.0F; }},
    {"an infinite distance of vertices that touch", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).proximity->squared_distance_m2 = INFINITY; }},
    {"a distance without vertices", "mixed", "proximity-bound",
     [](Recording& r) {
       core::Proximity& p = *bench::touch_of(r).proximity;
       p.vertex_a = p.vertex_b = core::Proximity{}.vertex_a;
     }},
    {"a pair that does not touch with a distance", "balls", "proximity-bound",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (core::Proximity& p : frame.proximity)
           if (!p.is_touching()) {
             p.squared_distance_m2 = 1.0F;
             return;
           }
       r.is_spoilable = false;
     }},
    {"a pair that does not touch with one vertex", "balls", "proximity-bound",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (core::Proximity& p : frame.proximity)
           if (!p.is_touching()) {
             p.vertex_b = 3;
             return;
           }
       r.is_spoilable = false;
     }},
    {"vertices that are as near, with higher numbers", "two-body:resting", "proximity-bound",
     [](Recording& r) {
       const bench::Touch touch = bench::touch_of(r);
       const auto vertices = static_cast<std::uint32_t>(r.header.scene.meshes[0]->vertices.size());
       const double same = bench::vertex_distance2(r, touch, touch.proximity->vertex_a, touch.proximity->vertex_b);
       for (std::uint32_t a = vertices; a-- > 0;)
         for (std::uint32_t b = vertices; b-- > 0;)
           if (bench::vertex_distance2(r, touch, a, b) == same && a != touch.proximity->vertex_a) {
             touch.proximity->vertex_a = a;
             touch.proximity->vertex_b = b;
             return;
           }
       r.is_spoilable = false;
     }},
    {"one distance too few", "mixed", "proximity-bound",
     [](Recording& r) { bench::touch_of(r).frame->proximity.pop_back(); }},
    {"no vertices were compared, it says", "mixed", "proximity-bound",
     [](Recording& r) {
       std::string& settings = r.header.stamp.settings;
       settings.replace(settings.find("vertex_stage=on"), 15, "vertex_stage=off");
     }},
};

TEST(Contradictions, OfVerticesThatTouch) {
  expect_rejected(kVertices);
}

constexpr Corruption kOctrees[] = {
    {"a root that is not the domain", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[0].box.max.y *= 2.0F; }},
    {"a node one level too deep", kOctree, "octree-invariants",
     [](Recording& r) { ++r.frames[0].octree_nodes[30].level; }},
    {"a child too few", kOctree, "octree-invariants", [](Recording& r) { --r.frames[0].octree_nodes[1].child_count; }},
    {"children of another node", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_nodes[1].first_child = r.frames[0].octree_nodes[2].first_child; }},
    {"halves that meet off the middle", kOctree, "octree-invariants",
     [](Recording& r) {
       auto& nodes = r.frames[0].octree_nodes;
       for (std::uint32_t k = 1; k < 9; ++k) (((k - 1) & 1U) != 0 ? nodes[k].box.min.x : nodes[k].box.max.x) += 0.01F;
     }},
    {"all bodies in the root", kOctree, "octree-invariants",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         std::fill(frame.octree_node_of_body.begin(), frame.octree_node_of_body.end(), 0);
     }},
    {"a body in a node that does not exist", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].octree_node_of_body[0] = 73; }},
    {"no octree in a middle frame", kOctree, "octree-invariants",
     [](Recording& r) {
       FrameRecord& frame = r.frames[r.frames.size() / 2];
       frame.octree_nodes.clear();
       frame.octree_node_of_body.clear();
     }},
    {"a leaf of a vertex that is none", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].leaf_of_vertex[0] = 64; }},
    {"a box of a middle level that is too small", kOctree, "octree-invariants",
     [](Recording& r) {
       for (std::size_t k = 1; k < 9; ++k) {
         Box& box = r.frames[0].body_octree_boxes[k];
         if (core::is_empty(box)) continue;
         box.max.x -= 1e-4F;
         return;
       }
       r.is_spoilable = false;
     }},
    {"body octrees without the root's box", kOctree, "octree-invariants",
     [](Recording& r) { r.frames[0].body_octree_boxes.erase(r.frames[0].body_octree_boxes.begin()); }},
    {"other body octrees in a later frame", kOctree, "octree-invariants",
     [](Recording& r) {
       FrameRecord& last = r.frames.back();
       last.shape_of_body = r.frames[0].shape_of_body;
       last.body_octree_boxes = r.frames[0].body_octree_boxes;
       last.leaf_of_vertex = r.frames[0].leaf_of_vertex;
       last.body_octree_boxes[0].max.x += 0.5F;
     }},
};

TEST(Contradictions, OfOctrees) {
  expect_rejected(kOctrees);
}

}  // namespace
}  // namespace broadside::tests
