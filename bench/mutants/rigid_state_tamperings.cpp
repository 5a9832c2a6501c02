#include <algorithm>
#include <utility>
#include <vector>

#include "bench/mutants/rigid_specimen_parts.hpp"

namespace broadside::bench {
namespace {

constexpr RigidTampering kRigidStateTamperings[] = {
    {"ballistic", "a free body gained 1 mm/s", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 20, kToTheEnd, [](FrameRecord& f) { f.wide.velocity[0].x += 1e-3; }); }},
    {"ballistic", "a free body lost a step of gravity", "rigid-mixed",
     [](Specimen& r) { at_step(r, 20, [](FrameRecord& f) { f.wide.velocity[0].y += 9.81 / 120.0; }); }},
    {"ballistic", "a free body jumped by a micrometer", "rigid-mixed",
     [](Specimen& r) { at_step(r, 20, [](FrameRecord& f) { f.wide.position[0].z += 1e-6; }); }},
    {"ballistic", "a free body jumped onto another one", "rigid-mixed",
     [](Specimen& r) { at_step(r, 20, [](FrameRecord& f) { f.wide.position[0] = f.wide.position[6]; }); }},
    {"ballistic", "two free bodies swapped", "rigid-mixed",
     [](Specimen& r) {
       at_step(r, 20, [](FrameRecord& f) {
         std::swap(f.wide.position[0], f.wide.position[1]);
         std::swap(f.wide.velocity[0], f.wide.velocity[1]);
       });
     }},
    {"ballistic", "a frame that is the one before", "rigid-mixed",
     [](Specimen& r) {
       const core::WideStates before = r.frames[18].wide;
       at_step(r, 20, [&](FrameRecord& f) { f.wide = before; });
     }},
    {"ballistic", "another gravity in the scene", "rigid-mixed",
     [](Specimen& r) { r.header.scene.gravity_m_s2.y = -9.8F; }},
    {"ballistic", "another step in the scene", "rigid-mixed", [](Specimen& r) { r.header.scene.dt_s = 1.0F / 119.0F; }},
    {"ballistic", "velocities in another frame of reference", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         for (WideVec3& v : f.wide.velocity) v.x += 0.5;
       });
     }},
    {"turning", "a free body turned by a milliradian too much", "rigid-mixed",
     [](Specimen& r) {
       at_step(r, 20, [](FrameRecord& f) { f.wide.orientation[0] = turned(f.wide.orientation[0], 1e-3); });
     }},
    {"turning", "orientations of the start", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         f.wide.orientation[0] = {};
         f.wide.orientation[1] = {};
       });
     }},
    {"turning", "orientations inverted: body from world", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         for (WideQuat& q : f.wide.orientation) q = {q.w, -q.x, -q.y, -q.z};
       });
     }},
    {"turning", "quaternions with the real part last", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         for (WideQuat& q : f.wide.orientation) q = {q.x, q.y, q.z, q.w};
       });
     }},
    {"turning", "angular velocities in degrees", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         for (WideVec3& w : f.wide.angular_velocity) w = {57.3 * w.x, 57.3 * w.y, 57.3 * w.z};
       });
     }},
    {"turning", "a frozen orientation at 1e6 rad/s", "rigid-million",
     [](Specimen& r) { in_frames(r, 1, kToTheEnd, [](FrameRecord& f) { f.wide.orientation[0] = {}; }); }},
    {"gyroscopic", "an angular velocity that stays while the brick turns", "rigid-mixed",
     [](Specimen& r) {
       const WideVec3 w = r.frames[18].wide.angular_velocity[0];
       in_frames(r, 19, 40, [&](FrameRecord& f) { f.wide.angular_velocity[0] = w; });
     }},
    {"gyroscopic", "a spin that grew by a thousandth", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 20, kToTheEnd, [](FrameRecord& f) {
         WideVec3& w = f.wide.angular_velocity[0];
         w = {1.001 * w.x, 1.001 * w.y, 1.001 * w.z};
       });
     }},
    {"gyroscopic", "another inertia in the scene", "rigid-mixed",
     [](Specimen& r) {
       core::Scene& scene = r.header.scene;
       std::vector<core::MassProperties> all;
       for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
         const auto m = core::mass_properties_of(scene, i);
         all.push_back(m ? m.value() : core::MassProperties{});
       }
       std::swap(all[0].inertia_kg_m2[0], all[0].inertia_kg_m2[1]);
       scene.mass_properties = all;
     }},
    {"gyroscopic", "a ball that stopped spinning in the air", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 3, 6, [](FrameRecord& f) { f.wide.angular_velocity[3] = {}; }); }},
    {"penetration", "a body 3 m under the floor", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 20, kToTheEnd, [](FrameRecord& f) { f.wide.position[6].y = -3.0; }); }},
    {"penetration", "a body two thirds in another", "rigid-stack",
     [](Specimen& r) { in_frames(r, 20, kToTheEnd, [](FrameRecord& f) { f.wide.position[2].y -= 0.66; }); }},
    {"penetration", "a body in a wall", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 20, kToTheEnd, [](FrameRecord& f) { f.wide.position[6].z = 10.1; }); }},
    {"passage", "a ball on the other side of a plate", "rigid-fast",
     [](Specimen& r) { in_frames(r, 8, kToTheEnd, [](FrameRecord& f) { f.wide.position[0].x = 0.5; }); }},
    {"passage", "a ball that skipped the frames in the plate", "rigid-fast",
     [](Specimen& r) { at_step(r, 5, [](FrameRecord& f) { f.wide.position[0].x = 1.0; }); }},
    {"rest", "a stack that creeps by 1 mm/s", "rigid-stack",
     [](Specimen& r) { in_frames(r, 1, kToTheEnd, [](FrameRecord& f) { f.wide.position[2].x += 1e-3 * f.time_s; }); }},
    {"rest", "a body of the stack that moved by 5 cm", "rigid-stack",
     [](Specimen& r) { in_frames(r, 100, kToTheEnd, [](FrameRecord& f) { f.wide.position[2].z += 0.05; }); }},
    {"rest", "a stack that sank", "rigid-stack",
     [](Specimen& r) {
       in_frames(r, 150, kToTheEnd, [](FrameRecord& f) {
         for (WideVec3& x : f.wide.position) x.y -= 0.02;
       });
     }},
    {"box-contains", "boxes of the frame before", "rigid-mixed",
     [](Specimen& r) {
       for (std::size_t k = r.frames.size() - 1; k > 0; --k) r.frames[k].boxes = r.frames[k - 1].boxes;
     }},
    {"box-contains", "one side of a box 10 micrometers in", "rigid-mixed",
     [](Specimen& r) { r.frames[20].boxes[0].min.y += 1e-5F; }},
    {"box-contains", "boxes of two bodies swapped", "rigid-mixed",
     [](Specimen& r) { std::swap(r.frames[20].boxes[3], r.frames[20].boxes[4]); }},
    {"box-contains", "a pose of detection that is that of the frame before", "rigid-mixed",
     [](Specimen& r) { r.frames[20].detected_orientation[0] = r.frames[16].detected_orientation[0]; }},
    {"closed-form", "a flight with another first velocity", "rigid-flight",
     [](Specimen& r) {
       r.header.scene.bodies[0].velocity.x = 2.01F;
       r.frames.erase(r.frames.begin());
     }},
    {"closed-form", "a flight that is a step late", "rigid-flight",
     [](Specimen& r) {
       for (std::size_t k = r.frames.size() - 1; k > 0; --k) r.frames[k].wide = r.frames[k - 1].wide;
     }},
    {"closed-form", "a ball that bounces lower than e says", "rigid-bounce",
     [](Specimen& r) {
       r.header.scene.bodies[0].material.restitution = r.header.scene.face_material.restitution = 0.95F;
     }},
    {"state-sanity", "a static body that moved", "rigid-mixed",
     [](Specimen& r) { at_step(r, 20, [](FrameRecord& f) { f.wide.position[8].x += 1e-4; }); }},
    {"state-sanity", "a static body that turned", "rigid-mixed",
     [](Specimen& r) {
       at_step(r, 20, [](FrameRecord& f) { f.wide.orientation[8] = turned(f.wide.orientation[8], 1e-4); });
     }},
    {"energy-growth", "a ball that bounced too high", "rigid-bounce",
     [](Specimen& r) { in_frames(r, 110, kToTheEnd, [](FrameRecord& f) { f.wide.velocity[0].y *= 1.2; }); }},
    {"energy-growth", "a sliding box that sped up", "rigid-slide",
     [](Specimen& r) { in_frames(r, 30, kToTheEnd, [](FrameRecord& f) { f.wide.velocity[0].x += 0.2; }); }},
    {"energy-growth", "a stack that was lifted", "rigid-stack",
     [](Specimen& r) {
       in_frames(r, 30, kToTheEnd, [](FrameRecord& f) {
         for (WideVec3& x : f.wide.position) x.y += 0.05;
       });
     }},
    {"determinism", "one bit of a float64 state", "rigid-mixed",
     [](Specimen& r) {
       at_step(r, 20, [](FrameRecord& f) { f.wide.velocity[0].x = std::nextafter(f.wide.velocity[0].x, 100.0); });
     },
     true},
    {"determinism", "another impulse at one point", "rigid-mixed",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         if (!f.points.empty()) return void(f.points[0].impulse.x += 1e-6F);
     },
     true},
};

}  // namespace

std::span<const RigidTampering> rigid_state_tamperings() {
  return kRigidStateTamperings;
}

}  // namespace broadside::bench
