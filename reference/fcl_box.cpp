// FCL on the axis-aligned boxes of bodies: box against box, the shapes of METHOD section 4.
#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/turned_shapes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_vector.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using Vector = fcl::Vector3<double>;

constexpr std::string_view kFclBoxId = "fcl-box";

// The world box in float, as the pipeline has it; center and sides are exact in double.
struct PlacedBox {
  fcl::Box<double> shape;
  fcl::Transform3<double> pose = fcl::Transform3<double>::Identity();

  explicit PlacedBox(const core::Box& b) {
    const Vector low(b.min.x, b.min.y, b.min.z);
    const Vector high(b.max.x, b.max.y, b.max.z);
    shape = fcl::Box<double>(high - low);
    pose.translation() = 0.5 * (low + high);
  }
};

Separation measure_boxes(const core::Box& box_a, const core::Box& box_b) {
  const PlacedBox a(box_a);
  const PlacedBox b(box_b);
  Separation out;
  // Two boxes make at most eight contacts; the deepest is the answer.
  const fcl::CollisionRequest<double> collision_request(/*num_max_contacts_=*/8, /*enable_contact_=*/true);
  fcl::CollisionResult<double> touch;
  out.is_touching = fcl::collide(&a.shape, a.pose, &b.shape, b.pose, collision_request, touch) > 0;
  if (out.is_touching) {
    for (std::size_t k = 0; k < touch.numContacts(); ++k) {
      const fcl::Contact<double>& contact = touch.getContact(k);
      if (k > 0 && -contact.penetration_depth >= out.distance_m) continue;
      out.distance_m = std::min(0.0, -contact.penetration_depth);
      out.normal = core_vector(-contact.normal);  // FCL's points from A to B
      out.witness_a = out.witness_b = core_vector(contact.pos);
    }
    return out;
  }
  fcl::DistanceRequest<double> distance_request(/*enable_nearest_points_=*/true);
  fcl::DistanceResult<double> near;
  fcl::distance(&a.shape, a.pose, &b.shape, b.pose, distance_request, near);
  out.distance_m = std::max(0.0, near.min_distance);
  out.witness_a = core_vector(near.nearest_points[0]);
  out.witness_b = core_vector(near.nearest_points[1]);
  const Vector from_b_to_a = near.nearest_points[0] - near.nearest_points[1];
  if (from_b_to_a.norm() > 0.0) out.normal = core_vector(from_b_to_a.normalized());
  return out;
}

class FclBox final : public core::NarrowPhase {
 public:
  explicit FclBox(int workers) : arena_(workers) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("fcl-box: load", [&]() -> Status {
      boxes_.load(scene);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kFclBoxId, pairs, poses, boxes_.body_count()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("fcl-box: measure", [&]() -> Status {
      const std::vector<const core::Box*> boxes = boxes_.of(pairs, poses);
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          const auto [i, j] = pairs[k];
          separations_[k] = measure_boxes(core::translated(*boxes[i], poses[i].position),
                                          core::translated(*boxes[j], poses[j].position));
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  tbb::task_arena arena_;
  TurnedShapes<core::Box> boxes_{
      [](const core::Mesh& mesh, core::Quat q) { return std::make_unique<core::Box>(turned_bounds(mesh, q)); }};
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> fcl_box_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> make_fcl_box(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kFclBoxId;
  engine.build = fcl_build();
  engine.settings = settings;
  const int workers = worker_count(settings.number("threads"));
  engine.narrow_phase = std::make_unique<FclBox>(workers);
  engine.equivalence = [workers](const core::Scene&) {
    core::EquivalenceCard card = fcl_card(workers);
    card.push_back({"shape", "axis-aligned boxes of the bodies", "triangle surfaces"});
    card.push_back({"shape margin", "none", ""});
    card.push_back({"tolerance", "1e-6 m, where its iterations stop", "none"});
    return card;
  };
  return engine;
}

}  // namespace

core::EngineRow fcl_box_row() {
  return {.id = kFclBoxId,
          .capabilities = "narrow",
          .what = "FCL's box against box on the axis-aligned boxes of bodies: depth and direction, or distance",
          .settings = fcl_box_settings(),
          .runs_in_child = true,
          .create = make_fcl_box,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
