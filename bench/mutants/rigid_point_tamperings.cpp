#include <algorithm>
#include <utility>

#include "bench/mutants/rigid_specimen_parts.hpp"

namespace broadside::bench {
namespace {

bool is_any(const ContactPoint&) {
  return true;
}

constexpr RigidTampering kRigidPointTamperings[] = {
    {"momentum", "impulses a thousandth too large", "rigid-mixed",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.impulse = 1.001F * p.impulse; }); }},
    {"momentum", "a point left out", "rigid-mixed",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         std::erase_if(f.points, [&](const ContactPoint& p) { return is_on_floor(p) && p.a == 2; });
     }},
    {"momentum", "impulses on B instead of A", "rigid-mixed",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.impulse = -1.0F * p.impulse; }); }},
    {"momentum", "friction that is not told", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_braked, [](ContactPoint& p) { p.impulse = along_normal(p); }); }},
    {"momentum", "a point of another body", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_on_floor, [](ContactPoint& p) { p.a = p.a == 2 ? 6 : p.a; }); }},
    {"momentum", "a body that touches and gained 1 mm/s", "rigid-mixed",
     [](Specimen& r) { at_step(r, 20, [](FrameRecord& f) { f.wide.velocity[2].z += 1e-3; }); }},
    {"momentum", "bodies that met and lost momentum, of a trace without points", "rigid-mixed",
     [](Specimen& r) {
       r.header.groups &= ~core::bit(core::Group::kPoints);
       for (FrameRecord& f : r.frames) f.points.clear();
       in_frames(r, 17, kToTheEnd, [](FrameRecord& f) { f.wide.velocity[4].x *= 0.9; });
     }},
    {"momentum", "impulses in grams", "rigid-mixed",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.impulse = 1000.0F * p.impulse; }); }},
    {"momentum", "the impulses of the frame before", "rigid-mixed",
     [](Specimen& r) {
       for (std::size_t k = r.frames.size() - 1; k > 0; --k) r.frames[k].points = r.frames[k - 1].points;
     }},
    {"angular-momentum", "points 10 cm off", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_between_bodies, [](ContactPoint& p) { p.point.z += 0.1F; }); }},
    {"angular-momentum", "points in coordinates of the body", "rigid-mixed",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         for (ContactPoint& p : f.points) p.point = p.point - f.detected_position[p.a];
     }},
    {"angular-momentum", "a body that was turned by nothing", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 20, kToTheEnd, [](FrameRecord& f) { f.wide.angular_velocity[2].y += 0.5; }); }},
    {"angular-momentum", "a bounce that changed no spin", "rigid-mixed",
     [](Specimen& r) {
       const WideVec3 w = r.frames[10].wide.angular_velocity[3];
       in_frames(r, 11, 40, [&](FrameRecord& f) { f.wide.angular_velocity[3] = w; });
     }},
    {"angular-momentum", "a ball that rolls without friction's moment", "rigid-mixed",
     [](Specimen& r) { in_frames(r, 1, kToTheEnd, [](FrameRecord& f) { f.wide.angular_velocity[9] = {}; }); }},
    {"friction-cone", "friction reversed", "rigid-mixed",
     [](Specimen& r) {
       at_points(r, is_braked, [](ContactPoint& p) { p.impulse = along_normal(p) - across_normal(p); });
     }},
    {"friction-cone", "friction at right angles", "rigid-slide",
     [](Specimen& r) {
       at_points(r, is_braked,
                 [](ContactPoint& p) { p.impulse = along_normal(p) + cross(p.normal, across_normal(p)); });
     }},
    {"friction-cone", "friction a twentieth beyond the cone", "rigid-slide",
     [](Specimen& r) {
       for (core::Body& b : r.header.scene.bodies) b.material.mu_static = b.material.mu_kinetic = 0.45F;
       r.header.scene.face_material = {0.45F, 0.45F, 0.0F};
     }},
    {"friction-cone", "friction a quarter short of the cone", "rigid-slide",
     [](Specimen& r) {
       at_points(r, is_braked, [](ContactPoint& p) { p.impulse = along_normal(p) + 0.75F * across_normal(p); });
     }},
    {"friction-cone", "no friction where something slides", "rigid-slide",
     [](Specimen& r) { at_points(r, is_braked, [](ContactPoint& p) { p.impulse = along_normal(p); }); }},
    {"friction-cone", "contacts that pull", "rigid-stack",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.impulse = -1.0F * p.impulse; }); }},
    {"friction-cone", "one point that pulls a little", "rigid-stack",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         if (f.step == 30 && !f.points.empty()) f.points[0].impulse = -1e-3F * f.points[0].normal;
     }},
    {"unilateral", "an impulse 5 cm above the floor", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_on_floor, [](ContactPoint& p) { p.gap_m = 0.05F; }); }},
    {"unilateral", "an impulse 2 cm above what stands", "rigid-stack",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.gap_m = 0.02F; }); }},
    {"unilateral", "an impulse over a gap of a meter", "rigid-bounce",
     [](Specimen& r) { at_points(r, carries, [](ContactPoint& p) { p.gap_m = 1.0F; }); }},
    {"contact-truth", "flipped normals", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_between_bodies, [](ContactPoint& p) { p.normal = -1.0F * p.normal; }); }},
    {"contact-truth", "flipped normals and impulses", "rigid-stack",
     [](Specimen& r) {
       at_points(r, carries, [](ContactPoint& p) {
         p.normal = -1.0F * p.normal;
         p.impulse = -1.0F * p.impulse;
       });
     }},
    {"contact-truth", "normals of length 1.001", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_any, [](ContactPoint& p) { p.normal = 1.001F * p.normal; }); }},
    {"contact-truth", "a floor whose normal is tilted", "rigid-slide",
     [](Specimen& r) { at_points(r, is_on_floor, [](ContactPoint& p) {
                         p.normal = {0.0995037F, 0.995037F, 0.0F};
                       }); }},
    {"contact-truth", "points of two bodies that are left out", "rigid-overlap",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         std::erase_if(f.points, [](const ContactPoint& p) { return !core::is_face(p.b); });
     }},
    {"contact-truth", "points with the floor that are left out", "rigid-overlap",
     [](Specimen& r) {
       for (FrameRecord& f : r.frames)
         std::erase_if(f.points, [](const ContactPoint& p) { return core::is_face(p.b); });
     }},
    {"contact-truth", "gaps of the other sign", "rigid-overlap",
     [](Specimen& r) { at_points(r, is_any, [](ContactPoint& p) { p.gap_m = -p.gap_m; }); }},
    {"contact-truth", "gaps in centimeters", "rigid-overlap",
     [](Specimen& r) { at_points(r, is_any, [](ContactPoint& p) { p.gap_m = 100.0F * p.gap_m; }); }},
    {"contact-truth", "points 10 cm above the floor", "rigid-stack",
     [](Specimen& r) { at_points(r, is_on_floor, [](ContactPoint& p) { p.point.y += 0.1F; }); }},
    {"contact-truth", "points 10 cm beside the body", "rigid-stack",
     [](Specimen& r) { at_points(r, is_any, [](ContactPoint& p) { p.point.x += p.point.x > 0.0F ? 0.1F : -0.1F; }); }},
    {"contact-truth", "an impulse between bodies that never met", "rigid-mixed",
     [](Specimen& r) { at_points(r, is_between_bodies, [](ContactPoint& p) { p.a = 0, p.b = 6; }); }},
};

}  // namespace

std::span<const RigidTampering> rigid_point_tamperings() {
  return kRigidPointTamperings;
}

}  // namespace broadside::bench
