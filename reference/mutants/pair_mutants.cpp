#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/method/levels.hpp"
#include "core/scene/shapes.hpp"
#include "reference/mutants/mutants.hpp"

namespace broadside::reference {
namespace {

using core::Box;
using core::FrameRecord;
using core::Pair;
using core::Proximity;
using core::Vec3;

void count_all(World& w) {
  w.candidates.demanded = w.candidates.raw = w.candidates.pairs.size();
}

// Every pair that passes `meets`, sorted.
template <typename Meets>
void pairs_that(World& w, const Meets& meets) {
  w.candidates.pairs.clear();
  for (std::uint32_t i = 0; i < w.bodies.count(); ++i)
    for (std::uint32_t j = i + 1; j < w.bodies.count(); ++j)
      if (meets(i, j)) w.candidates.pairs.push_back({i, j});
  count_all(w);
}

bool is_movable(const World& w, std::uint32_t i, std::uint32_t j) {
  return w.bodies.is_static[i] == 0 || w.bodies.is_static[j] == 0;
}

const ShapeData& shape_of(const World& w, std::uint32_t body) {
  return w.bodies.shapes[w.bodies.shape[body]];
}

// Level 2 of A against level 2 of B, without the nodes that `skips` names by their place in level 2.
template <typename Skips>
bool leaves_meet(const World& w, Pair p, const Skips& skips) {
  const core::NodeBoxes& a = shape_of(w, p.i).boxes;
  const core::NodeBoxes& b = shape_of(w, p.j).boxes;
  for (int r = 0; r < a.level2_count; ++r)
    for (int s = 0; s < b.level2_count; ++s)
      if (!skips(a, r) && !skips(b, s) &&
          core::overlaps_at(a.level2[r], w.bodies.state[p.i].x, b.level2[s], w.bodies.state[p.j].x))
        return true;
  return false;
}

// The nearest of the vertex pairs that `counts` allows, below `limit2`.
template <typename Counts>
Proximity nearest_of(const World& w, Pair p, float limit2, const Counts& counts) {
  const core::BodyOctree& a = shape_of(w, p.i).shape.octree;
  const core::BodyOctree& b = shape_of(w, p.j).shape.octree;
  Proximity best;
  for (std::size_t r = 0; r < a.sorted_vertices.size(); ++r)
    for (std::size_t s = 0; s < b.sorted_vertices.size(); ++s) {
      const float d2 = core::squared_distance(a.sorted_vertices[r] + w.bodies.state[p.i].x,
                                              b.sorted_vertices[s] + w.bodies.state[p.j].x);
      if (!(d2 < limit2) || !counts(a.sorted_vertices[r], b.sorted_vertices[s])) continue;
      const Proximity found{d2, a.sorted_indices[r], b.sorted_indices[s]};
      if (core::is_nearer(found, best)) best = found;
    }
  return best;
}

float theta_of(const World& w, Pair p) {
  return core::pair_theta_m(w.scene->parameters, shape_of(w, p.i).shape, shape_of(w, p.j).shape);
}

constexpr auto kEvery = [](Vec3, Vec3) { return true; };

std::span<const Mutant> pair_table() {
  static const auto kTable = std::to_array<Mutant>({
      {"drops-last-pair",
       "the last candidate of every frame is lost",
       "candidate-set",
       "mixed",
       {.candidates =
            [](World& w) {
              if (!w.candidates.pairs.empty()) w.candidates.pairs.pop_back();
              count_all(w);
            }}},
      {"drops-odd-sums",
       "pairs whose ids add up to an odd number are lost",
       "candidate-set",
       "pile",
       {.candidates =
            [](World& w) {
              std::erase_if(w.candidates.pairs, [](Pair p) { return (p.i + p.j) % 2 != 0; });
              count_all(w);
            }}},
      {"duplicates-pairs",
       "every candidate is listed twice",
       "candidate-set",
       "mixed",
       {.candidates =
            [](World& w) {
              auto& pairs = w.candidates.pairs;
              pairs.insert(pairs.end(), pairs.begin(), pairs.end());
              std::sort(pairs.begin(), pairs.end());
              count_all(w);
            }}},
      {"keeps-stale-pairs",
       "pairs of the frame before are kept",
       "candidate-set",
       "mixed",
       {.candidates =
            [](World& w) {
              std::vector<Pair> both;
              std::set_union(w.candidates.pairs.begin(), w.candidates.pairs.end(), w.last_pairs.begin(),
                             w.last_pairs.end(), std::back_inserter(both));
              w.candidates.pairs = both;
              count_all(w);
            }}},
      {"lags-one-frame",
       "candidates are those of the boxes one frame ago",
       "candidate-set",
       "mixed",
       {.candidates =
            [](World& w) {
              pairs_that(w, [&w](std::uint32_t i, std::uint32_t j) {
                return is_movable(w, i, j) && core::overlaps(w.last_boxes[i], w.last_boxes[j]);
              });
            }}},
      {"touching-does-not-count",
       "boxes that touch count as apart",
       "candidate-set",
       "touching",
       {.candidates =
            [](World& w) {
              std::erase_if(w.candidates.pairs, [&w](Pair p) {
                const Box& a = w.bodies.boxes[p.i];
                const Box& b = w.bodies.boxes[p.j];
                for (int k = 0; k < 3; ++k)
                  if (a.min[k] == b.max[k] || b.min[k] == a.max[k]) return true;
                return false;
              });
              count_all(w);
            }}},
      {"ignores-one-axis",
       "boxes are compared on x and y alone",
       "candidate-set",
       "pile",
       {.candidates =
            [](World& w) {
              pairs_that(w, [&w](std::uint32_t i, std::uint32_t j) {
                const Box& a = w.bodies.boxes[i];
                const Box& b = w.bodies.boxes[j];
                return is_movable(w, i, j) && a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y &&
                       b.min.y <= a.max.y;
              });
            }}},
      {"reverses-pairs",
       "pairs are listed with the higher id first",
       "candidate-set",
       "mixed",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (Pair& p : frame.pairs) std::swap(p.i, p.j);
            }}},
      {"fattens-boxes",
       "a margin of 5 cm is never filtered away",
       "candidate-set",
       "mixed",
       {.candidates =
            [](World& w) {
              pairs_that(w, [&w](std::uint32_t i, std::uint32_t j) {
                Box a = w.bodies.boxes[i];
                for (int k = 0; k < 3; ++k) a.min[k] -= 0.05F, a.max[k] += 0.05F;
                return is_movable(w, i, j) && core::overlaps(a, w.bodies.boxes[j]);
              });
            }}},
      {"pairs-static-bodies",
       "two static bodies are a pair",
       "candidate-set",
       "pile",
       {.candidates =
            [](World& w) {
              pairs_that(w, [&w](std::uint32_t i, std::uint32_t j) {
                return core::overlaps(w.bodies.boxes[i], w.bodies.boxes[j]);
              });
            }}},
      {"rounds-boxes-to-half",
       "boxes are compared in float16",
       "candidate-set",
       "pile",
       {.candidates =
            [](World& w) {
              const auto half = [](float v) { return std::ldexp(std::nearbyint(std::ldexp(v, 7)), -7); };
              pairs_that(w, [&](std::uint32_t i, std::uint32_t j) {
                const Box& a = w.bodies.boxes[i];
                const Box& b = w.bodies.boxes[j];
                bool meet = is_movable(w, i, j);
                for (int k = 0; k < 3; ++k)
                  meet = meet && half(a.min[k]) <= half(b.max[k]) && half(b.min[k]) <= half(a.max[k]);
                return meet;
              });
            }}},
      {"truncates-list",
       "only two pairs fit, but more are demanded",
       "capacity",
       "pile",
       {.candidates =
            [](World& w) {
              if (w.candidates.pairs.size() > 2) w.candidates.pairs.resize(2);
            }}},
      {"miscounts-demand",
       "the demanded count stays that of the first frame",
       "capacity",
       "mixed",
       {.candidates = [](World& w) { w.candidates.demanded = 0; }}},
      {"skips-first-child",
       "the first leaf of every octree is never tested",
       "level-agreement",
       "corner",
       {.confirms =
            [](const World& w, Pair p) {
              return leaves_meet(w, p, [](const core::NodeBoxes&, int leaf) { return leaf == 0; });
            }}},
      {"skips-last-child",
       "the last leaf of every octree is never tested",
       "level-agreement",
       "corner",
       {.confirms =
            [](const World& w, Pair p) {
              return leaves_meet(w, p, [](const core::NodeBoxes& b, int leaf) { return leaf + 1 == b.level2_count; });
            }}},
      {"stops-one-level-high",
       "level 1 is taken for the last level",
       "level-agreement",
       "balls",
       {.confirms =
            [](const World& w, Pair p) {
              return core::is_confirmed(core::Levels::kLevel1, shape_of(w, p.i).boxes, w.bodies.state[p.i].x,
                                        shape_of(w, p.j).boxes, w.bodies.state[p.j].x);
            }}},
      {"confirms-all",
       "whole boxes stand in for the last level",
       "level-agreement",
       "balls",
       {.confirms = [](const World&, Pair) { return true; }}},
      {"tests-stale-leaves",
       "leaves are tested where bodies were one frame ago",
       "level-agreement",
       "balls",
       {.confirms =
            [](const World& w, Pair p) {
              return core::is_confirmed(core::Levels::kC, shape_of(w, p.i).boxes, w.last_state[p.i].x,
                                        shape_of(w, p.j).boxes, w.last_state[p.j].x);
            }}},
      {"theta-on-square",
       "theta is compared with the squared distance",
       "proximity-bound",
       "balls",
       {.nearest = [](const World& w, Pair p, const Proximity&) { return nearest_of(w, p, theta_of(w, p), kEvery); }}},
      {"misses-end-vertices",
       "vertices on the upper x side of a mesh are never looked at",
       "proximity-bound",
       "mixed",
       {.nearest =
            [](const World& w, Pair p, const Proximity&) {
              const float theta = theta_of(w, p);
              return nearest_of(w, p, theta * theta, [&](Vec3 a, Vec3 b) {
                return a.x < w.bodies.local_box(p.i).max.x && b.x < w.bodies.local_box(p.j).max.x;
              });
            }}},
      {"takes-any-near-pair",
       "the first vertex pair below theta is taken, not the nearest",
       "proximity-bound",
       "pile",
       {.nearest =
            [](const World& w, Pair p, const Proximity& sound) {
              const float theta = theta_of(w, p);
              const auto& a = shape_of(w, p.i).shape.octree;
              const auto& b = shape_of(w, p.j).shape.octree;
              for (std::size_t r = 0; r < a.sorted_vertices.size(); ++r)
                for (std::size_t s = 0; s < b.sorted_vertices.size(); ++s) {
                  const float d2 = core::squared_distance(a.sorted_vertices[r] + w.bodies.state[p.i].x,
                                                          b.sorted_vertices[s] + w.bodies.state[p.j].x);
                  if (d2 < theta * theta) return Proximity{d2, a.sorted_indices[r], b.sorted_indices[s]};
                }
              return sound;
            }}},
      {"forgets-to-square",
       "the distance is recorded where its square belongs",
       "proximity-bound",
       "mixed",
       {.nearest =
            [](const World&, Pair, const Proximity& sound) {
              Proximity p = sound;
              p.squared_distance_m2 = std::sqrt(p.squared_distance_m2);
              return p;
            }}},
      {"swaps-witnesses",
       "the vertex of A is recorded for B",
       "proximity-bound",
       "mixed",
       {.nearest =
            [](const World&, Pair, const Proximity& sound) {
              Proximity p = sound;
              std::swap(p.vertex_a, p.vertex_b);
              return p;
            }}},
      {"theta-of-one-mesh",
       "theta is half the mean edge",
       "proximity-bound",
       "balls",
       {.nearest =
            [](const World& w, Pair p, const Proximity& sound) {
              const float theta = 0.5F * theta_of(w, p);
              return sound.squared_distance_m2 < theta * theta ? sound : Proximity{};
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const Mutant> pair_mutants() {
  return pair_table();
}

}  // namespace broadside::reference
