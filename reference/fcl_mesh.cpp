// FCL on triangle meshes: BVHModel<OBBRSS>, distance with nearest points, and collide for the touching flag.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_defects.hpp"
#include "reference/vendor_vector.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using Model = fcl::BVHModel<fcl::OBBRSS<double>>;

constexpr std::string_view kFclMeshId = "fcl-mesh";

std::unique_ptr<Model> make_model(const core::Mesh& mesh) {
  std::vector<fcl::Vector3<double>> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const core::Vec3 v : mesh.vertices) vertices.emplace_back(v.x, v.y, v.z);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const core::Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);

  auto model = std::make_unique<Model>();
  const bool is_built =
      model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size())) == fcl::BVH_OK &&
      model->addSubModel(vertices, triangles) == fcl::BVH_OK && model->endModel() == fcl::BVH_OK;
  if (!is_built) throw std::runtime_error("BVHModel could not be built for mesh '" + mesh.name + "'");
  return model;
}

// Normalized in double: a float quaternion is a unit only to 1e-7, and FCL takes the matrix as it is.
fcl::Transform3<double> mesh_pose(const core::Pose& pose) {
  const core::Quat q = pose.orientation;
  fcl::Transform3<double> t = fcl::Transform3<double>::Identity();
  t.linear() = fcl::Quaternion<double>(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  t.translation() = fcl::Vector3<double>(pose.position.x, pose.position.y, pose.position.z);
  return t;
}

Separation measure_meshes(const Model& a, const fcl::Transform3<double>& pose_a, const Model& b,
                          const fcl::Transform3<double>& pose_b, bool asks_collide) {
  Separation out;
  fcl::DistanceRequest<double> distance_request(/*enable_nearest_points_=*/true);
  fcl::DistanceResult<double> near;
  fcl::distance(&a, pose_a, &b, pose_b, distance_request, near);
  // FCL has no penetration depth for meshes: any value below zero becomes 0, "overlap of unknown depth".
  out.distance_m = std::max(0.0, near.min_distance);
  out.witness_a = core_vector(near.nearest_points[0]);
  out.witness_b = core_vector(near.nearest_points[1]);
  if (out.distance_m > 0.0) {
    const fcl::Vector3<double> from_b_to_a = near.nearest_points[0] - near.nearest_points[1];
    if (from_b_to_a.norm() > 0.0) out.normal = core_vector(from_b_to_a.normalized());
  }
  if (!asks_collide) {
    out.is_touching = out.distance_m == 0.0;
    return out;
  }
  const fcl::CollisionRequest<double> collision_request(/*num_max_contacts_=*/1, /*enable_contact_=*/false);
  fcl::CollisionResult<double> touch;
  out.is_touching = fcl::collide(&a, pose_a, &b, pose_b, collision_request, touch) > 0;
  return out;
}

class FclMesh final : public core::NarrowPhase {
 public:
  FclMesh(int workers, bool asks_collide, SharedDefectCounter no_depth)
      : arena_(workers), asks_collide_(asks_collide), no_depth_(std::move(no_depth)) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("fcl-mesh: load", [&]() -> Status {
      models_.clear();
      model_of_body_.clear();
      for (const auto& mesh : scene.meshes) models_.push_back(make_model(*mesh));
      for (const core::Body& body : scene.bodies) model_of_body_.push_back(models_[body.mesh].get());
      return core::Done{};
    });
  }

  // Pairs are independent and FCL keeps its state in objects of the call, so they are computed in parallel, each into
  // its own slot: the answer does not depend on the number of workers.
  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kFclMeshId, pairs, poses, model_of_body_.size()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("fcl-mesh: measure", [&]() -> Status {
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          const auto [i, j] = pairs[k];
          separations_[k] = measure_meshes(*model_of_body_[i], mesh_pose(poses[i]), *model_of_body_[j],
                                           mesh_pose(poses[j]), asks_collide_);
          no_depth_->note(separations_[k].is_touching ? 1 : 0, 1);
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  tbb::task_arena arena_;
  bool asks_collide_;
  SharedDefectCounter no_depth_;
  std::vector<std::unique_ptr<Model>> models_;
  std::vector<const Model*> model_of_body_;
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> fcl_mesh_settings() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"query",
       "both",
       {"both", "distance"},
       "distance with nearest points and collide, which is sure about touching; or distance alone, 0 = touching"},
      threads_setting(),
  }};
  return kSettings;
}

core::Result<core::Engine> make_fcl_mesh(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kFclMeshId;
  engine.build = fcl_build();
  engine.settings = settings;
  const int workers = worker_count(settings.number("threads"));
  const auto no_depth = std::make_shared<DefectCounter>(Defect::kFclMeshDepth);
  engine.narrow_phase = std::make_unique<FclMesh>(workers, settings.text("query") == "both", no_depth);
  engine.equivalence = [workers](const core::Scene&) {
    core::EquivalenceCard card = fcl_card(workers);
    card.push_back({"shape", "BVHModel<OBBRSS> of the triangles, turned in double", ""});
    card.push_back({"shape margin", "none", ""});
    card.push_back({"tolerance", "none for distances; 0 in overlap", ""});
    return card;
  };
  engine.defects = defects_of(no_depth);
  return engine;
}

}  // namespace

core::EngineRow fcl_mesh_row() {
  return {.id = kFclMeshId,
          .capabilities = "narrow",
          .what = "FCL's distance and collide on triangle meshes (OBBRSS trees)",
          .settings = fcl_mesh_settings(),
          .runs_in_child = true,
          .create = make_fcl_mesh,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
