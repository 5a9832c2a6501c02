#include <cmath>
#include <utility>

#include "bench/mutants/specimen_parts.hpp"
#include "bench/mutants/tamperings.hpp"

namespace broadside::bench {
namespace {

constexpr Tampering kStateTamperings[] = {
    {"state-sanity", "NaN", [](Specimen& r) { r.frames[9].position[5].y = kNoNumber; }},
    {"state-sanity", "infinity", [](Specimen& r) { r.frames[9].angular_velocity[5].y = INFINITY; }},
    {"state-sanity", "NaN in a box", [](Specimen& r) { r.frames[9].boxes[5].min.x = kNoNumber; }},
    {"state-sanity", "an inverted box",
     [](Specimen& r) { std::swap(r.frames[9].boxes[5].min, r.frames[9].boxes[5].max); }},
    {"state-sanity", "a quaternion that is not unit", [](Specimen& r) { r.frames[9].orientation[1].w = 1.00001F; }},
    {"state-sanity", "a quaternion of zeros",
     [](Specimen& r) {
       r.frames[9].orientation[1] = {0, 0, 0, 0};
     }},
    {"state-sanity", "drift between two frames", [](Specimen& r) { r.frames[9].position[5].x += 1e-5F; }},
    {"state-sanity", "a lost step of gravity",
     [](Specimen& r) { r.frames[9].detected_velocity[5].y += 9.81F / 60.0F; }},
    {"state-sanity", "explicit Euler: moved with the old velocity",
     [](Specimen& r) {
       r.frames[9].detected_position[5].y = r.frames[8].position[5].y + r.header.scene.dt_s * r.frames[8].velocity[5].y;
     }},
    {"state-sanity", "a first frame that does not start from the scene",
     [](Specimen& r) { r.header.scene.bodies[5].position.x += 0.01F; }},
    {"state-sanity", "a box that is not the body's", [](Specimen& r) { r.frames[9].boxes[5].max.z += 1e-5F; }},
    {"state-sanity", "a contact that starts from a stale state",
     [](Specimen& r) { contact_that(r, is_bounce).pre_a.v.y *= 0.5F; }},
    {"state-sanity", "an end state that no contact left", [](Specimen& r) { r.frames[9].velocity[5].x = 0.25F; }},
    {"state-sanity", "velocities that were not clipped",
     [](Specimen& r) { r.header.scene.parameters.v_max_m_s = 0.125F; }},
    {"state-sanity", "a body outside the domain in silence",
     [](Specimen& r) {
       FrameRecord& frame = r.frames[9];
       for (auto* x : {&frame.position[5], &frame.detected_position[5]}) x->x = 0.25F;
     }},
    {"state-sanity", "a contact of a body with itself",
     [](Specimen& r) {
       Contact& c = contact_that(r, is_shared);
       c.b = c.a;
     }},
    {"state-sanity", "a contact with a body that does not exist",
     [](Specimen& r) { contact_that(r, is_shared).b = 77; }},
    {"state-sanity", "a missing body", [](Specimen& r) { r.frames[9].velocity.pop_back(); }},
    {"state-sanity", "time that runs wrong", [](Specimen& r) { r.frames[9].time_s += 0.001; }},
    {"state-sanity", "an orientation that jumps",
     [](Specimen& r) {
       r.frames[9].orientation[1] = {0.6F, 0.0F, 0.8F, 0.0F};
     }},
    {"state-sanity", "an angular velocity of a million",
     [](Specimen& r) {
       r.frames[9].angular_velocity[1] = {0.0F, 1e6F, 0.0F};
     }},
    {"state-sanity", "a static body with a velocity", [](Specimen& r) { r.frames.back().velocity[2].x = 1.0F; }},
    {"frame-digest", "zeros for digests",
     [](Specimen& r) {
       for (FrameRecord& frame : r.frames) frame.digest = 0;
     }},
    {"frame-digest", "a digest of another frame", [](Specimen& r) { r.frames[9].digest = r.frames[8].digest; }},
    {"frame-digest", "a digest that does not see the tangent impulse",
     [](Specimen& r) { contact_that(r, is_slide).tangent_impulse_n_s *= 1.0000002F; }},
    {"recording", "a level that is not that of the frames",
     [](Specimen& r) { r.header.level = core::RecordLevel::kDigest; }},
    {"recording", "a step left out",
     [](Specimen& r) {
       r.statistics.clear();
       r.frames.erase(r.frames.begin() + 9);
     }},
    {"recording", "statistics without one contact", [](Specimen& r) { --r.statistics.front().body_contacts; }},
    {"recording", "another mean depth", [](Specimen& r) { r.statistics.front().mean_depth_m *= 1.0 + 1e-9; }},
    {"determinism", "one bit of a position",
     [](Specimen& r) { r.frames[20].position[1].x = std::nextafter(r.frames[20].position[1].x, 100.0F); }, true},
    {"determinism", "a zero of the other sign", [](Specimen& r) { r.frames[20].angular_velocity[1].x = -0.0F; }, true},
    {"determinism", "another digest", [](Specimen& r) { r.frames[20].digest ^= 1; }, true},
    {"determinism", "another digest in a trace of digests alone",
     [](Specimen& r) {
       r.header.groups = 0;
       r.frames[20].digest ^= 1;
     },
     true},
    {"determinism", "a contact more", [](Specimen& r) { r.frames[20].contacts.emplace_back(); }, true},
    {"determinism", "contacts in another order",
     [](Specimen& r) {
       for (FrameRecord& frame : r.frames)
         if (frame.contacts.size() > 1) return std::swap(frame.contacts[0], frame.contacts[1]);
     },
     true},
};

}  // namespace

std::span<const Tampering> state_tamperings() {
  return kStateTamperings;
}

}  // namespace broadside::bench
