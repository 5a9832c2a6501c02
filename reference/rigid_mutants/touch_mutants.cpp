#include <array>
#include <utility>

#include "core/contact.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using plain::SolverPoint;
using plain::Vec;

bool is_of_bodies(const SolverPoint& p) {
  return !core::is_face(p.b);
}

template <typename Fits>
void lose_points(StagedWorld& w, double h, const Fits& fits) {
  w.sound_find_points(h);
  std::erase_if(w.points_, fits);
}

template <typename Change>
void change_points(StagedWorld& w, double h, const Change& change) {
  w.sound_find_points(h);
  for (SolverPoint& p : w.points_) change(p);
}

std::span<const RigidMutant> touch_table() {
  static const auto kTable = std::to_array<RigidMutant>({
      {"ignores-a-pair",
       "the lower two of the stack never touch",
       "contact-truth",
       "rigid-stack",
       {.find_points = [](StagedWorld& w,
                          double h) { lose_points(w, h, [](const SolverPoint& p) { return p.a == 0 && p.b == 1; }); }}},
      {"ignores-the-floor",
       "one body falls through the floor",
       "contact-truth",
       "rigid-stack",
       {.find_points =
            [](StagedWorld& w, double h) {
              lose_points(w, h, [](const SolverPoint& p) { return p.a == 0 && core::is_face(p.b); });
            }}},
      {"no-contacts",
       "bodies do not touch each other",
       "penetration",
       "rigid-stack",
       {.find_points = [](StagedWorld& w, double h) { lose_points(w, h, is_of_bodies); }}},
      {"under-the-floor",
       "a body rests 3 m under the floor",
       "penetration",
       "rigid-mixed",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              w.bodies_[3].x.y = static_cast<double>(w.scene().domain.min.y) - 3.0;
            }}},
      {"tunnels",
       "bodies that are apart at the start of a step get no contact in it",
       "passage",
       "rigid-fast",
       {.find_points = [](StagedWorld& w,
                          double h) { lose_points(w, h, [](const SolverPoint& p) { return p.at.gap > 0.0; }); }}},
      {"turns-a-plate-through",
       "a body that only turns is not checked for contacts while it turns",
       "passage",
       "rigid-blade",
       {.find_points = [](StagedWorld& w,
                          double h) { lose_points(w, h, [](const SolverPoint& p) { return p.at.gap > 0.0; }); }}},
      {"flips-normals",
       "normals point from A to B",
       "contact-truth",
       "rigid-mixed",
       {.find_points = [](StagedWorld& w,
                          double h) { change_points(w, h, [](SolverPoint& p) { p.at.normal = -p.at.normal; }); }}},
      {"normals-between-centers",
       "the normal of two bodies is the line between their centers",
       "contact-truth",
       "rigid-offset",
       {.find_points =
            [](StagedWorld& w, double h) {
              change_points(w, h, [&w](SolverPoint& p) {
                if (!is_of_bodies(p)) return;
                const Vec d = w.bodies_[p.a].x - w.bodies_[p.b].x;
                p.at.normal = (1.0 / length(d)) * d;
              });
            }}},
      {"one-point-a-pair",
       "all points of two bodies lie at the first one, 10 cm on",
       "contact-truth",
       "rigid-stack",
       {.find_points = [](StagedWorld& w,
                          double h) { change_points(w, h, [](SolverPoint& p) { p.at.point.y += 0.1; }); }}},
      {"sees-no-depth",
       "overlaps count as touching",
       "contact-truth",
       "rigid-overlap",
       {.find_points =
            [](StagedWorld& w, double h) {
              change_points(w, h, [](SolverPoint& p) { p.at.gap = std::max(0.0, p.at.gap); });
            }}},
      {"sees-too-much-depth",
       "bodies count as 3 cm deeper than they are",
       "contact-truth",
       "rigid-overlap",
       {.find_points = [](StagedWorld& w,
                          double h) { change_points(w, h, [](SolverPoint& p) { p.at.gap -= 0.03; }); }}},
      {"pushes-at-a-distance",
       "bodies keep 5 cm between them",
       "unilateral",
       "rigid-mixed",
       {.find_points = [](StagedWorld& w, double h) { w.sound_find_points(20.0 * h); },
        .solve_contacts =
            [](StagedWorld& w, double h) {
              for (SolverPoint& p : w.points_) p.at.gap -= 0.05;
              w.sound_solve_contacts(h);
              for (SolverPoint& p : w.points_) p.at.gap += 0.05;
            }}},
      {"lifts-all-at-once",
       "a step takes away all of the depth where a fifth is declared",
       "energy-growth",
       "rigid-overlap",
       {.separate =
            [](StagedWorld& w) {
              for (int k = 0; k < 5; ++k) w.sound_separate();
            }}},
      {"creeps",
       "a stack creeps by 1 mm/s",
       "rest",
       "rigid-stack",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              for (std::size_t i = 0; i < w.bodies_.size(); ++i)
                if (!w.bodies_[i].is_static()) w.bodies_[i].x.x += 1e-3 * h;
            }}},
      {"sinks",
       "standing bodies sink by 2 mm/s",
       "rest",
       "rigid-stack",
       {.move =
            [](StagedWorld& w, double h) {
              w.sound_move(h);
              w.bodies_[0].x.y -= 2e-3 * h;
            },
        .separate = [](StagedWorld&) {}}},
      {"collapses",
       "the topmost body is nudged off its stack",
       "rest",
       "rigid-stack",
       {.accelerate =
            [](StagedWorld& w, double h) {
              w.sound_accelerate(h);
              w.bodies_.back().v.x += 8.0 * h;
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const RigidMutant> touch_mutants() {
  return touch_table();
}

}  // namespace broadside::reference
