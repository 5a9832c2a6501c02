// The turning pipeline with one stage replaced. Every stage is broken at least once.
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/contact.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using core::ContactPatch;
using core::ContactPoint;
using core::FrameRecord;
using core::RigidState;
using core::Vec3;

template <typename Change>
void for_moving(StagedPipeline& p, const Change& change) {
  for (std::uint32_t i = 0; i < p.bodies_.count(); ++i)
    if (p.bodies_.is_static[i] == 0) change(p.bodies_.state[i], i);
}

// Responds to other materials than the scene's.
template <typename Change>
void respond_with_materials(StagedPipeline& p, float dt_s, const Change& change) {
  const std::vector<core::Material> sound = p.bodies_.material;
  for (core::Material& m : p.bodies_.material) change(m);
  p.sound_respond(dt_s);
  p.bodies_.material = sound;
}

template <typename Change>
void change_patches(StagedPipeline& p, const Change& change) {
  for (ContactPatch& patch : p.patches_) change(patch);
}

// The columns of RigidMutant that differ here.
struct Row {
  std::string_view name;
  std::string_view what;
  std::string_view law;
  std::string_view scene;
  TurningStages stages;
  bool differs_from_run_to_run = false;
};

std::vector<RigidMutant> mutants_of(std::span<const Row> rows) {
  std::vector<RigidMutant> out;
  for (const Row& r : rows)
    out.push_back({.name = r.name,
                   .what = r.what,
                   .law = r.law,
                   .scene = r.scene,
                   .stages = {},
                   .differs_from_run_to_run = r.differs_from_run_to_run,
                   .turning = r.stages,
                   .is_of_pipeline = true});
  return out;
}

constexpr Row kRows[] = {
    {"twin: boxes-of-the-step-before",
     "boxes are those of the step before",
     "box-contains",
     "rigid-mixed",
     {.place =
          [](StagedPipeline& p, float h) {
            p.sound_place(h);
            if (p.step_number() == p.last_placed) return;
            p.last_placed = p.step_number();
            std::swap(p.bodies_.boxes, p.last_boxes);
            if (p.bodies_.boxes.empty()) p.bodies_.boxes = p.last_boxes;
          }}},
    {"twin: boxes-that-do-not-turn",
     "boxes are those of the body before it turned",
     "box-contains",
     "rigid-mixed",
     {.place =
          [](StagedPipeline& p, float h) {
            const std::vector<RigidState> sound = p.bodies_.state;
            for_moving(p, [&](RigidState& s, std::uint32_t i) { s.q = p.scene().bodies[i].orientation; });
            p.sound_place(h);
            p.bodies_.state = p.bodies_.detected = sound;
          }}},
    {"twin: drops-a-candidate",
     "the last candidate pair is lost",
     "candidate-set",
     "rigid-stack",
     {.find_candidates = [](StagedPipeline& p) -> core::Status {
       core::Status s = p.sound_find_candidates();
       if (!p.candidates_.pairs.empty()) p.candidates_.pairs.pop_back();
       return s;
     }}},
    {"twin: leaves-a-pair-unconfirmed",
     "the levels reject two bodies that touch",
     "contact-truth",
     "rigid-stack",
     {.confirm =
          [](StagedPipeline& p) {
            p.sound_confirm();
            std::erase_if(p.confirmed_, [](core::Pair q) { return q.i == 0; });
          }}},
    {"twin: flips-normals",
     "normals of two bodies point from A to B",
     "contact-truth",
     "rigid-mixed",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            change_patches(p, [](ContactPatch& patch) {
              if (!core::is_face(patch.b)) patch.manifold.normal = Vec3{} - patch.manifold.normal;
            });
          }}},
    {"twin: points-off",
     "points of contact lie 10 cm off",
     "contact-truth",
     "rigid-stack",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            change_patches(p, [](ContactPatch& patch) {
              for (core::ManifoldPoint& point : patch.manifold.points) point.point.y += 0.1F;
            });
          }}},
    {"twin: gaps-doubled",
     "gaps are twice as wide as they are",
     "contact-truth",
     "rigid-overlap",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            change_patches(p, [](ContactPatch& patch) {
              for (core::ManifoldPoint& point : patch.manifold.points) point.gap_m *= 2.0F;
            });
          }}},
    {"twin: patches-that-stay",
     "a patch is never updated after it was made",
     "contact-truth",
     "rigid-overlap",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            change_patches(p, [&p](ContactPatch& patch) {
              for (const ContactPatch& last : p.last_touching)
                if (last.a == patch.a && last.b == patch.b) patch.manifold = last.manifold;
            });
            p.last_touching = p.patches_;
          }}},
    {"twin: no-patches-of-bodies",
     "bodies do not touch each other",
     "penetration",
     "rigid-stack",
     {.touch_bodies =
          [](StagedPipeline& p) {
            const std::vector<core::Pair> sound = p.confirmed_;
            p.confirmed_.clear();
            p.sound_touch_bodies();
            p.confirmed_ = sound;
          }}},
    {"twin: sees-what-touches-alone",
     "bodies that do not touch yet get no contacts",
     "passage",
     "rigid-fast",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            std::erase_if(p.patches_,
                          [](const ContactPatch& patch) { return core::least_gap_m(patch.manifold) > 0.0F; });
          }}},
    {"twin: ignores-the-floor",
     "one body falls through the floor",
     "contact-truth",
     "rigid-stack",
     {.touch_faces =
          [](StagedPipeline& p) {
            p.sound_touch_faces();
            std::erase_if(p.patches_, [](const ContactPatch& q) { return q.a == 0 && core::is_face(q.b); });
          }}},
    {"twin: gravity-by-the-step",
     "velocities gain gravity twice",
     "ballistic",
     "rigid-mixed",
     {.respond =
          [](StagedPipeline& p, float h) {
            for_moving(p, [&](RigidState& s, std::uint32_t) { s.v = s.v + h * p.scene().gravity_m_s2; });
            p.sound_respond(h);
          }}},
    {"twin: half-rate",
     "orientation at half rate",
     "turning",
     "rigid-mixed",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            for_moving(p, [&](RigidState& s, std::uint32_t i) {
              const core::Quat before = p.bodies_.detected[i].q;
              const core::Quat sum = before + s.q;
              s.q = (1.0F / sqrtf(core::dot(sum, sum))) * sum;
            });
          }}},
    {"twin: frozen-orientation",
     "orientations never change",
     "turning",
     "rigid-mixed",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            for_moving(p, [&](RigidState& s, std::uint32_t i) { s.q = p.bodies_.detected[i].q; });
          }}},
    {"twin: angular-momentum-in-body-axes",
     "the angular momentum turns with the body",
     "gyroscopic",
     "rigid-mixed",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            for_moving(p, [&](RigidState& s, std::uint32_t i) {
              s.angular_momentum = core::rotate(s.q, core::rotate_back(p.bodies_.detected[i].q, s.angular_momentum));
            });
          }}},
    {"twin: one-sided",
     "impulses act on body A alone",
     "momentum",
     "rigid-stack",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            RigidState& top = p.bodies_.state[p.bodies_.count() - 1];
            top.v = p.bodies_.detected[p.bodies_.count() - 1].v + h * p.scene().gravity_m_s2;
          }}},
    {"twin: loses-moments",
     "impulses do not turn bodies",
     "angular-momentum",
     "rigid-offset",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            for_moving(p, [&](RigidState& s, std::uint32_t i) {
              s.angular_momentum = p.bodies_.detected[i].angular_momentum;
            });
          }}},
    {"twin: no-friction",
     "surfaces are smooth",
     "friction-cone",
     "rigid-slide",
     {.respond =
          [](StagedPipeline& p, float h) {
            respond_with_materials(p, h, [](core::Material& m) { m.mu_static = m.mu_kinetic = 0.0F; });
          }}},
    {"twin: friction-fourfold",
     "coefficients of friction are four times as large",
     "friction-cone",
     "rigid-slide",
     {.respond =
          [](StagedPipeline& p, float h) {
            respond_with_materials(p, h, [](core::Material& m) {
              m.mu_static *= 16.0F;
              m.mu_kinetic *= 16.0F;
            });
          }}},
    {"twin: bounces-too-high",
     "restitution 1.2",
     "energy-growth",
     "rigid-bounce",
     {.respond = [](StagedPipeline& p,
                    float h) { respond_with_materials(p, h, [](core::Material& m) { m.restitution = 1.2F; }); }}},
    {"twin: creeps",
     "bodies at rest creep by 1 mm/s",
     "rest",
     "rigid-stack",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            for_moving(p, [&](RigidState& s, std::uint32_t) { s.x.x += 1e-2F * h; });
          }}},
    {"twin: tells-half-of-impulses",
     "points carry half of the impulse",
     "momentum",
     "rigid-stack",
     {.tell_points =
          [](StagedPipeline& p) {
            p.sound_tell_points();
            for (ContactPoint& point : p.points_) point.impulse = 0.5F * point.impulse;
          }}},
    {"twin: tells-a-wrong-pose",
     "the recorded pose of detection is that of the end of the step",
     "box-contains",
     "rigid-million",
     {.tell =
          [](StagedPipeline&, FrameRecord& f) {
            f.detected_position.assign(f.position.size(), {0, -3, 0});
          }}},
    {"twin: differs-from-run-to-run",
     "the last bit of a result depends on the run",
     "determinism",
     "rigid-mixed",
     {.respond =
          [](StagedPipeline& p, float h) {
            p.sound_respond(h);
            if (p.run() == 1 && p.step_number() == 7)
              p.bodies_.state[0].v.x = std::nextafter(p.bodies_.state[0].v.x, 100.0F);
          }},
     true},
};

}  // namespace

std::span<const RigidMutant> pipeline_mutants() {
  static const std::vector<RigidMutant> kTable = mutants_of(kRows);
  return kTable;
}

}  // namespace broadside::reference
