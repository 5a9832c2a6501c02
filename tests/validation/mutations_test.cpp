// Every wrong trace of the catalogue is rejected. A validator that cannot fail is a defect.
#include "tests/validation/mutations.hpp"

#include <map>
#include <string>
#include <utility>

#include "tests/validation/contact_mutations.hpp"

namespace broadside::tests {
namespace {

const std::vector<Mutation> kPairMutations = {
    {"candidate-set", "a dropped pair", [](Recording& r) { frame_with_pairs(r).pairs.clear(); }},
    {"candidate-set", "a stale pair",
     [](Recording& r) {
       r.frames[0].pairs.push_back({1, 5});
     }},
    {"candidate-set", "a repeated pair",
     [](Recording& r) {
       auto& pairs = frame_with_pairs(r).pairs;
       pairs.insert(pairs.begin(), pairs.front());
     }},
    {"candidate-set", "a pair with i above j",
     [](Recording& r) {
       Pair& p = frame_with_pairs(r).pairs.front();
       std::swap(p.i, p.j);
     }},
    {"candidate-set", "a pair of a body with itself",
     [](Recording& r) {
       r.frames[0].pairs.push_back({5, 5});
     }},
    {"candidate-set", "a pair with a body that does not exist",
     [](Recording& r) {
       r.frames[0].pairs.push_back({5, 6});
     }},
    {"candidate-set", "pairs out of order",
     [](Recording& r) {
       r.frames[0].pairs = {{2, 3}, {0, 1}};
     }},
    {"candidate-set", "boxes missing", [](Recording& r) { r.frames[3].boxes.pop_back(); }},
    {"capacity", "a truncated pair list", [](Recording& r) { frame_with_pairs(r).pairs.pop_back(); }},
    {"capacity", "more stored than demanded", [](Recording& r) { frame_with_pairs(r).pairs_demanded = 0; }},
    {"level-agreement", "a confirmed pair lost",
     [](Recording& r) {
       FrameRecord& frame = frame_with_pairs(r);
       frame.confirmed.clear();
       frame.proximity.clear();
     }},
    {"level-agreement", "a confirmed pair whose boxes are apart",
     [](Recording& r) {
       r.frames[0].confirmed.push_back({1, 5});
       r.frames[0].proximity.push_back({});
     }},
};

const std::vector<Mutation> kProximityMutations = {
    // theta is about 0.28 m: theta^2 = 0.08 m^2, and a distance up to sqrt(theta) = 0.53 m passes d^2 < theta.
    {"proximity-bound", "theta tested on the squared distance", [](Recording& r) { retarget(r, 0.3, 0.5); }},
    {"proximity-bound", "a missed vertex", [](Recording& r) { retarget(r, 0.2, 0.284); }},
    {"proximity-bound", "not touching where vertices are", [](Recording& r) { *touch_of(r).proximity = {}; }},
    {"proximity-bound", "a distance that is not that of the witnesses",
     [](Recording& r) { touch_of(r).proximity->squared_distance_m2 *= 0.9F; }},
    {"proximity-bound", "a distance that was not squared",
     [](Recording& r) {
       float& d = touch_of(r).proximity->squared_distance_m2;
       d = std::sqrt(d);
     }},
    {"proximity-bound", "a witness that is no vertex", [](Recording& r) { touch_of(r).proximity->vertex_b = 1000000; }},
    {"proximity-bound", "swapped witnesses",
     [](Recording& r) {
       core::Proximity& p = *touch_of(r).proximity;
       std::swap(p.vertex_a, p.vertex_b);
     }},
    {"proximity-bound", "a proximity list that is too short",
     [](Recording& r) {
       FrameRecord& frame = *touch_of(r).frame;
       frame.confirmed.push_back({4, 5});
     }},
    {"proximity-bound", "NaN", [](Recording& r) { touch_of(r).proximity->squared_distance_m2 = kNoNumber; }},
};

const std::vector<Mutation> kStateMutations = {
    {"state-sanity", "NaN", [](Recording& r) { r.frames[9].position[5].y = kNoNumber; }},
    {"state-sanity", "infinity", [](Recording& r) { r.frames[9].angular_velocity[5].y = INFINITY; }},
    {"state-sanity", "NaN in a box", [](Recording& r) { r.frames[9].boxes[5].min.x = kNoNumber; }},
    {"state-sanity", "an inverted box",
     [](Recording& r) { std::swap(r.frames[9].boxes[5].min, r.frames[9].boxes[5].max); }},
    {"state-sanity", "a quaternion that is not unit", [](Recording& r) { r.frames[9].orientation[1].w = 1.00001F; }},
    {"state-sanity", "a quaternion of zeros",
     [](Recording& r) {
       r.frames[9].orientation[1] = {0, 0, 0, 0};
     }},
    {"state-sanity", "drift between two frames", [](Recording& r) { r.frames[9].position[5].x += 1e-5F; }},
    {"state-sanity", "a lost step of gravity",
     [](Recording& r) { r.frames[9].detected_velocity[5].y += 9.81F / 60.0F; }},
    {"state-sanity", "explicit Euler: moved with the old velocity",
     [](Recording& r) {
       r.frames[9].detected_position[5].y = r.frames[8].position[5].y + r.header.scene.dt_s * r.frames[8].velocity[5].y;
     }},
    {"state-sanity", "a first frame that does not start from the scene",
     [](Recording& r) { r.header.scene.bodies[5].position.x += 0.01F; }},
    {"state-sanity", "a box that is not the body's", [](Recording& r) { r.frames[9].boxes[5].max.z += 1e-5F; }},
    {"state-sanity", "a contact that starts from a stale state",
     [](Recording& r) { contact_that(r, is_bounce).pre_a.v.y *= 0.5F; }},
    {"state-sanity", "an end state that no contact left", [](Recording& r) { r.frames[9].velocity[5].x = 0.25F; }},
    {"state-sanity", "velocities that were not clipped",
     [](Recording& r) { r.header.scene.parameters.v_max_m_s = 0.125F; }},
    {"state-sanity", "a body outside the domain in silence",
     [](Recording& r) {
       FrameRecord& frame = r.frames[9];
       for (auto* x : {&frame.position[5], &frame.detected_position[5]}) x->x = 0.25F;
     }},
    {"state-sanity", "a contact of a body with itself",
     [](Recording& r) {
       Contact& c = contact_that(r, is_shared);
       c.b = c.a;
     }},
    {"state-sanity", "a contact with a body that does not exist",
     [](Recording& r) { contact_that(r, is_shared).b = 77; }},
    {"state-sanity", "a missing body", [](Recording& r) { r.frames[9].velocity.pop_back(); }},
    {"state-sanity", "time that runs wrong", [](Recording& r) { r.frames[9].time_s += 0.001; }},
    {"determinism", "one bit of a position",
     [](Recording& r) { r.frames[20].position[1].x = std::nextafter(r.frames[20].position[1].x, 100.0F); }, true},
    {"determinism", "a zero of the other sign", [](Recording& r) { r.frames[20].angular_velocity[1].x = -0.0F; }, true},
    {"determinism", "another digest", [](Recording& r) { r.frames[20].digest ^= 1; }, true},
    {"determinism", "another digest in a trace of digests alone",
     [](Recording& r) {
       r.header.groups = 0;
       r.frames[20].digest ^= 1;
     },
     true},
    {"determinism", "a contact more", [](Recording& r) { r.frames[20].contacts.emplace_back(); }, true},
    {"determinism", "contacts in another order",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         if (frame.contacts.size() > 1) return std::swap(frame.contacts[0], frame.contacts[1]);
     },
     true},
};

std::vector<Mutation> all_mutations() {
  std::vector<Mutation> all;
  for (const auto* part : {&kPairMutations, &kProximityMutations, &kNormalMutations, &kPositionMutations,
                           &kVelocityMutations, &kStateMutations})
    all.insert(all.end(), part->begin(), part->end());
  return all;
}

TEST(Mutations, EachIsRejectedByItsValidator) {
  std::map<std::string_view, int> rejected;
  for (const Mutation& m : all_mutations()) {
    Recording wrong = sound();
    m.apply(wrong);
    const core::Verdict v = verdict_of(std::string(m.validator), wrong, m.against_the_sound_one ? &sound() : nullptr);
    EXPECT_EQ(v.outcome, core::Outcome::kFail) << m.what << ": " << line(v);
    EXPECT_GT(v.violations, 0u) << m.what;
    rejected[m.validator] += v.outcome == core::Outcome::kFail;
  }
  int sum = 0;
  for (const auto& [validator, count] : rejected) sum += count;
  RecordProperty("mutants_rejected", sum);
  EXPECT_EQ(sum, static_cast<int>(all_mutations().size()));
  // Every validator of the table has something that it must reject.
  for (const validation::ValidatorRow& row : validation::validators()) EXPECT_GT(rejected[row.name], 0) << row.name;
}

}  // namespace
}  // namespace broadside::tests
