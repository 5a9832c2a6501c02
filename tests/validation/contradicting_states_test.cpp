// Frames that do not follow from each other, and records that contradict the frames beside them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/trace/statistics.hpp"
#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

// Computes the statistics anew from the changed record, as a forger would write them.
void count_again(Recording& r) {
  core::PenetrationCounter counter(r.header.scene.parameters.delta_m);
  r.statistics.clear();
  for (const FrameRecord& frame : r.frames)
    if (const auto row = counter.add(frame.step, frame.contacts)) r.statistics.push_back(*row);
  if (const auto row = counter.rest()) r.statistics.push_back(*row);
}

void number_from(Recording& r, std::uint64_t first) {
  for (FrameRecord& frame : r.frames) {
    frame.step = first++;
    frame.time_s = static_cast<double>(frame.step) * r.header.scene.dt_s;
  }
  count_again(r);
}

constexpr Corruption kMotion[] = {
    {"all velocities halved", "balls", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (auto* list : {&frame.velocity, &frame.detected_velocity})
           for (Vec3& v : *list) v = 0.5F * v;
     }},
    {"a velocity that turns round in the last frame", "balls", "state-sanity",
     [](Recording& r) { r.frames.back().velocity[0] = -1.0F * r.frames.back().velocity[0]; }},
    {"velocities of two bodies exchanged", "balls", "state-sanity",
     [](Recording& r) { std::swap(middle(r).velocity[0], middle(r).velocity[1]); }},
    {"a state seen twice", "two-body:slide", "state-sanity",
     [](Recording& r) {
       r.frames[9].detected_position = r.frames[8].detected_position;
       r.frames[9].detected_velocity = r.frames[8].detected_velocity;
     }},
    {"what was seen is the end of the frame", "two-body:head-on", "state-sanity",
     [](Recording& r) {
       FrameRecord& frame = frame_with(r, is_pushing);
       frame.detected_position = frame.position;
       frame.detected_velocity = frame.velocity;
     }},
    {"the last frame a second time", "balls", "state-sanity",
     [](Recording& r) {
       FrameRecord again = r.frames.back();
       again.time_s = static_cast<double>(++again.step) * r.header.scene.dt_s;
       r.frames.push_back(again);
     }},
    {"positions told to a millimeter", "balls", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (Vec3& x : frame.position)
           for (int k = 0; k < 3; ++k) x[k] = std::round(x[k] * 1000.0F) / 1000.0F;
     }},
    {"a body that trembles by one rounding", "two-body:rest", "state-sanity",
     [](Recording& r) { middle(r).position[0].x = std::nextafter(middle(r).position[0].x, 100.0F); }},
    {"a position that jumps in the first frame", "two-body:apart", "state-sanity",
     [](Recording& r) { r.frames.front().position[0].x += 1e-3F; }},
    {"time that goes backwards", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).time_s = -middle(r).time_s; }},
    {"a time of zero", "two-body:apart", "state-sanity", [](Recording& r) { middle(r).time_s = 0.0; }},
    {"a static body seen with a velocity", "two-body:resting", "state-sanity",
     [](Recording& r) {
       for (std::uint32_t i = 0; i < r.header.scene.body_count(); ++i)
         if (!(r.header.scene.bodies[i].inverse_mass > 0.0F)) middle(r).detected_velocity[i].x = 0.5F;
     }},
    {"boxes of two bodies exchanged", "two-body:apart", "state-sanity",
     [](Recording& r) { std::swap(middle(r).boxes[0], middle(r).boxes[1]); }},
    {"a box of no extent", "two-body:apart", "state-sanity",
     [](Recording& r) {
       middle(r).boxes[0] = {middle(r).detected_position[0], middle(r).detected_position[0]};
     }},
    {"a box grown by a margin", "two-body:apart", "state-sanity",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         for (Box& box : frame.boxes)
           box = {box.min + Vec3{-0.01F, -0.01F, -0.01F}, box.max + Vec3{0.01F, 0.01F, 0.01F}};
     }},
    {"boxes where the bodies end", "two-body:slide", "state-sanity",
     [](Recording& r) {
       FrameRecord& frame = frame_with(r, [](const Contact& c) { return !(c.post_a.x == c.pre_a.x); });
       for (std::size_t i = 0; i < frame.boxes.size(); ++i) {
         const Vec3 moved = frame.position[i] - frame.detected_position[i];
         frame.boxes[i] = core::translated(frame.boxes[i], moved);
       }
     }},
    {"one orientation less", "two-body:apart", "state-sanity", [](Recording& r) { middle(r).orientation.pop_back(); }},
    {"a body more in one list", "two-body:apart", "state-sanity",
     [](Recording& r) { middle(r).detected_velocity.emplace_back(); }},
    {"a hundredth of the speed from nowhere", "balls", "energy",
     [](Recording& r) {
       for (FrameRecord& frame : r.frames)
         if (frame.step > 5) frame.velocity[0] = 1.01F * frame.velocity[0];
     }},
    {"a height from nowhere", "two-body:resting", "energy",
     [](Recording& r) {
       for (std::uint32_t i = 0; i < r.header.scene.body_count(); ++i)
         if (r.header.scene.bodies[i].inverse_mass > 0.0F) middle(r).position[i].y += 1e-3F;
     }},
};

TEST(Contradictions, OfMotion) {
  expect_rejected(kMotion);
}

constexpr Corruption kRecords[] = {
    {"steps that begin at 101", "two-body:slide", "recording", [](Recording& r) { number_from(r, 101); }},
    {"steps that begin at 2", "two-body:slide", "recording", [](Recording& r) { number_from(r, 2); }},
    {"the first five frames taken away", "two-body:slide", "recording",
     [](Recording& r) {
       r.frames.erase(r.frames.begin(), r.frames.begin() + 5);
       count_again(r);
     }},
    {"a frame taken away behind a note of windows", "two-body:slide", "recording",
     [](Recording& r) {
       r.header.notes["windows of steps"] = "1:" + std::to_string(r.frames.back().step);
       r.frames.erase(r.frames.begin() + 7);
       count_again(r);
     }},
    {"windows of steps that other frames are in", "two-body:slide", "recording",
     [](Recording& r) { r.header.notes["windows of steps"] = "1:5"; }},
    {"windows of steps that are no windows", "two-body:slide", "recording",
     [](Recording& r) { r.header.notes["windows of steps"] = "some"; }},
    {"every zeroth frame, it says", "two-body:slide", "recording", [](Recording& r) { r.header.every = 0; }},
    {"statistics of the frames before the last", "two-body:rest", "recording",
     [](Recording& r) {
       const FrameRecord last = r.frames.back();
       r.frames.pop_back();
       count_again(r);
       r.frames.push_back(last);
     }},
    {"statistics with another slop", "mixed", "recording",
     [](Recording& r) {
       const float delta_m = std::exchange(r.header.scene.parameters.delta_m, 0.05F);
       count_again(r);
       r.header.scene.parameters.delta_m = delta_m;
     }},
    {"digests of two frames exchanged", "two-body:slide", "frame-digest",
     [](Recording& r) { std::swap(r.frames[3].digest, r.frames[4].digest); }, Digests::kKept},
};

TEST(Contradictions, OfRecords) {
  expect_rejected(kRecords);
}

}  // namespace
}  // namespace broadside::tests
