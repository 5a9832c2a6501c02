#include <utility>

#include "bench/mutants/rigid_specimen_parts.hpp"

namespace broadside::bench {
namespace {

// Sound motion under a declaration that lies.
constexpr RigidTampering kRigidDeclarationTamperings[] = {
    {"closed-form", "an order that is too high", "rigid-spin-up",
     [](Specimen& r) {
       declare(r, {{"order", "4"}});
     }},
    {"energy-growth", "no position correction declared", "rigid-overlap",
     [](Specimen& r) {
       declare(r, {{"correction", "none"}});
     }},
    {"energy-growth", "a tenth of the true rate of correction declared", "rigid-overlap",
     [](Specimen& r) {
       declare(r, {{"correction_rate", "0.02"}});
     }},
    {"ballistic", "float64 declared of states that were rounded to float32", "rigid-mixed",
     [](Specimen& r) {
       in_frames(r, 1, kToTheEnd, [](FrameRecord& f) {
         for (std::size_t i = 0; i < f.position.size(); ++i) {
           f.wide.position[i] = {f.position[i].x, f.position[i].y, f.position[i].z};
           f.wide.velocity[i] = {f.velocity[i].x, f.velocity[i].y, f.velocity[i].z};
         }
       });
     }},
    {"state-sanity", "the method of bodies that translate declared", "rigid-mixed",
     [](Specimen& r) {
       declare(r, {{"method", "octree-aabb"}});
     }},
    {"turning", "bodies that turn declared to translate", "rigid-mixed",
     [](Specimen& r) {
       declare(r, {{"motion", "translate"}});
     }},
    {"box-contains", "detection declared at the end of the step", "rigid-mixed",
     [](Specimen& r) {
       declare(r, {{"detection_at", "end"}});
       r.header.groups &= ~core::bit(core::Group::kDetectedOrientation);
       for (FrameRecord& f : r.frames) f.detected_orientation.clear();
     }},
    {"friction-cone", "a pyramid declared of friction beyond it", "rigid-slide",
     [](Specimen& r) {
       declare(r, {{"friction", "pyramid"}});
       at_points(r, is_braked, [](ContactPoint& p) { p.impulse = along_normal(p) + 1.8F * across_normal(p); });
     }},
    {"unilateral", "a margin of 1 cm declared where 2 cm act", "rigid-stack",
     [](Specimen& r) {
       declare(r, {{"contact_margin_m", "0.01"}});
       at_points(r, carries, [](ContactPoint& p) { p.gap_m = 0.02F; });
     }},
};

}  // namespace

std::span<const RigidTampering> rigid_declaration_tamperings() {
  return kRigidDeclarationTamperings;
}

}  // namespace broadside::bench
