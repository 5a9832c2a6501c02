#include <cmath>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "bench/mutants/tamperings.hpp"

namespace broadside::bench {
namespace {

constexpr Tampering kPairTamperings[] = {
    {"candidate-set", "a dropped pair", [](Specimen& r) { frame_with_pairs(r).pairs.clear(); }},
    {"candidate-set", "a stale pair",
     [](Specimen& r) {
       r.frames[0].pairs.push_back({1, 5});
     }},
    {"candidate-set", "a repeated pair",
     [](Specimen& r) {
       auto& pairs = frame_with_pairs(r).pairs;
       pairs.insert(pairs.begin(), pairs.front());
     }},
    {"candidate-set", "a pair with i above j",
     [](Specimen& r) {
       Pair& p = frame_with_pairs(r).pairs.front();
       std::swap(p.i, p.j);
     }},
    {"candidate-set", "a pair of a body with itself",
     [](Specimen& r) {
       r.frames[0].pairs.push_back({5, 5});
     }},
    {"candidate-set", "a pair with a body that does not exist",
     [](Specimen& r) {
       r.frames[0].pairs.push_back({5, 6});
     }},
    {"candidate-set", "pairs out of order",
     [](Specimen& r) {
       r.frames[0].pairs = {{2, 3}, {0, 1}};
     }},
    {"candidate-set", "boxes missing", [](Specimen& r) { r.frames[3].boxes.pop_back(); }},
    {"capacity", "a truncated pair list", [](Specimen& r) { frame_with_pairs(r).pairs.pop_back(); }},
    {"capacity", "more stored than demanded", [](Specimen& r) { frame_with_pairs(r).pairs_demanded = 0; }},
    {"capacity", "fewer raw pairs than were left of them", [](Specimen& r) { frame_with_pairs(r).pairs_raw = 0; }},
    {"proximity-bound", "no proximities in one frame", [](Specimen& r) { touch_of(r).frame->proximity.clear(); }},
    {"level-agreement", "a confirmed pair lost",
     [](Specimen& r) {
       FrameRecord& frame = frame_with_pairs(r);
       frame.confirmed.clear();
       frame.proximity.clear();
     }},
    {"level-agreement", "a confirmed pair whose boxes are apart",
     [](Specimen& r) {
       r.frames[0].confirmed.push_back({1, 5});
       r.frames[0].proximity.push_back({});
     }},
    // theta is about 0.28 m: theta^2 = 0.08 m^2, and a distance up to sqrt(theta) = 0.53 m passes d^2 < theta.
    {"proximity-bound", "theta tested on the squared distance", [](Specimen& r) { retarget(r, 0.3, 0.5); }},
    {"proximity-bound", "a missed vertex", [](Specimen& r) { retarget(r, 0.2, 0.284); }},
    {"proximity-bound", "not touching where vertices are", [](Specimen& r) { *touch_of(r).proximity = {}; }},
    {"proximity-bound", "a distance that is not that of the witnesses",
     [](Specimen& r) { touch_of(r).proximity->squared_distance_m2 *= 0.9F; }},
    {"proximity-bound", "a distance that was not squared",
     [](Specimen& r) {
       float& d = touch_of(r).proximity->squared_distance_m2;
       d = std::sqrt(d);
     }},
    {"proximity-bound", "a witness that is no vertex", [](Specimen& r) { touch_of(r).proximity->vertex_b = 1000000; }},
    {"proximity-bound", "swapped witnesses",
     [](Specimen& r) {
       core::Proximity& p = *touch_of(r).proximity;
       std::swap(p.vertex_a, p.vertex_b);
     }},
    {"proximity-bound", "a proximity list that is too short",
     [](Specimen& r) {
       FrameRecord& frame = *touch_of(r).frame;
       frame.confirmed.push_back({4, 5});
     }},
    {"proximity-bound", "NaN", [](Specimen& r) { touch_of(r).proximity->squared_distance_m2 = kNoNumber; }},
};

}  // namespace

std::span<const Tampering> pair_tamperings() {
  return kPairTamperings;
}

}  // namespace broadside::bench
