#include <array>
#include <cmath>
#include <utility>

#include "core/contact.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"

namespace broadside::reference {
namespace {

using core::ContactPoint;
using core::FrameRecord;

template <typename Change>
void for_points(FrameRecord& frame, const Change& change) {
  for (ContactPoint& p : frame.points) change(p);
}

std::span<const RigidMutant> telling_table() {
  static const auto kTable = std::to_array<RigidMutant>({
      {"tells-flipped-normals",
       "normals are reported from A to B",
       "contact-truth",
       "rigid-mixed",
       {.tell = [](StagedWorld&,
                   FrameRecord& f) { for_points(f, [](ContactPoint& p) { p.normal = -1.0F * p.normal; }); }}},
      {"tells-long-normals",
       "normals are reported with the length of the impulse",
       "contact-truth",
       "rigid-mixed",
       {.tell = [](StagedWorld&,
                   FrameRecord& f) { for_points(f, [](ContactPoint& p) { p.normal = 1.01F * p.normal; }); }}},
      {"tells-points-10-cm-off",
       "points are reported 10 cm from where they were",
       "angular-momentum",
       "rigid-mixed",
       {.tell = [](StagedWorld&, FrameRecord& f) { for_points(f, [](ContactPoint& p) { p.point.x += 0.1F; }); }}},
      {"tells-half-impulses",
       "half of each impulse is reported",
       "momentum",
       "rigid-mixed",
       {.tell = [](StagedWorld&,
                   FrameRecord& f) { for_points(f, [](ContactPoint& p) { p.impulse = 0.5F * p.impulse; }); }}},
      {"tells-forces",
       "forces are reported where impulses belong",
       "momentum",
       "rigid-mixed",
       {.tell =
            [](StagedWorld& w, FrameRecord& f) {
              const float per_step = 1.0F / w.scene().dt_s;
              for_points(f, [&](ContactPoint& p) { p.impulse = per_step * p.impulse; });
            }}},
      {"tells-the-normal-part-alone",
       "friction is not reported",
       "momentum",
       "rigid-mixed",
       {.tell =
            [](StagedWorld&, FrameRecord& f) {
              for_points(f, [](ContactPoint& p) { p.impulse = dot(p.impulse, p.normal) * p.normal; });
            }}},
      {"tells-the-last-points",
       "points are those of the frame before",
       "momentum",
       "rigid-mixed",
       {.tell = [](StagedWorld& w, FrameRecord& f) { f.points = w.last_told.points; }}},
      {"boxes-one-frame-old",
       "boxes are those of the frame before",
       "box-contains",
       "rigid-mixed",
       {.tell =
            [](StagedWorld& w, FrameRecord& f) {
              if (!w.last_told.boxes.empty()) f.boxes = w.last_told.boxes;
            }}},
      {"boxes-do-not-turn",
       "boxes are those of the shape before it turned",
       "box-contains",
       "rigid-mixed",
       {.tell =
            [](StagedWorld& w, FrameRecord& f) {
              for (std::size_t i = 0; i < f.boxes.size(); ++i)
                for (int k = 0; k < 3; ++k) {
                  const auto& b = w.bodies_[i];
                  const double half = b.radius > 0.0 ? b.radius : b.half_extents[k];
                  f.boxes[i].min[k] = static_cast<float>(f.detected_position[i][k] - half);
                  f.boxes[i].max[k] = static_cast<float>(f.detected_position[i][k] + half);
                }
            }}},
      {"boxes-a-millimeter-small",
       "boxes are a millimeter too small",
       "box-contains",
       "rigid-mixed",
       {.tell =
            [](StagedWorld&, FrameRecord& f) {
              for (core::Box& b : f.boxes) b.max.x -= 1e-3F;
            }}},
      {"pose-of-detection-lags",
       "the pose of detection is one frame old",
       "box-contains",
       "rigid-mixed",
       {.tell =
            [](StagedWorld& w, FrameRecord& f) {
              if (!w.last_told.boxes.empty()) f.detected_position = w.last_told.detected_position;
            }}},
      {"static-bodies-drift",
       "a static body is reported 1 mm from where it is",
       "state-sanity",
       "rigid-mixed",
       {.tell = [](StagedWorld&, FrameRecord& f) { f.wide.position[8].x += 1e-3; }}},
      {"orientation-lags",
       "orientations are those of the frame before",
       "turning",
       "rigid-mixed",
       {.tell =
            [](StagedWorld& w, FrameRecord& f) {
              if (!w.last_told.wide.orientation.empty()) f.wide.orientation = w.last_told.wide.orientation;
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const RigidMutant> telling_mutants() {
  return telling_table();
}

}  // namespace broadside::reference
