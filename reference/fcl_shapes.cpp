// FCL on primitives and convex bodies: signed distance, or collide with its contacts, with either of its two solvers.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/primitive.hpp"
#include "reference/engines.hpp"
#include "reference/pair_check.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_vector.hpp"
#include "reference/worker_count.hpp"

namespace broadside::reference {
namespace {

using core::Separation;
using core::Status;
using Vector = fcl::Vector3<double>;
using Transform = fcl::Transform3<double>;

constexpr std::string_view kFclShapesId = "fcl-shapes";

// A shape of FCL and its pose in the body: FCL's capsules lie along z.
struct BodyShape {
  std::unique_ptr<fcl::CollisionGeometry<double>> geometry;
  Transform in_body = Transform::Identity();
  std::string what;
  double facet_gap_m = 0.0;
};

std::unique_ptr<fcl::CollisionGeometry<double>> convex(const core::Mesh& mesh) {
  auto vertices = std::make_shared<std::vector<Vector>>();
  for (const core::Vec3 v : mesh.vertices) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const core::Triangle& t : mesh.triangles) {
    faces->push_back(3);
    for (const std::uint32_t v : t) faces->push_back(static_cast<int>(v));
  }
  return std::make_unique<fcl::Convex<double>>(vertices, static_cast<int>(mesh.triangles.size()), faces, true);
}

std::optional<BodyShape> shape_of(const core::Mesh& mesh) {
  BodyShape out;
  const auto primitive = core::primitive_of(mesh);
  if (!primitive) {
    if (!core::is_convex(mesh)) return std::nullopt;
    out.geometry = convex(mesh);
    out.what = "convex body";
    return out;
  }
  out.what = core::primitive_word(primitive->kind);
  out.facet_gap_m = primitive->facet_gap_m;
  const core::Vec3 half = primitive->half_extents;
  const double radius = primitive->radius_m;
  if (primitive->kind == core::PrimitiveKind::kBox) {
    out.geometry = std::make_unique<fcl::Box<double>>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
  } else if (primitive->kind == core::PrimitiveKind::kSphere) {
    out.geometry = std::make_unique<fcl::Sphere<double>>(radius);
  } else {
    const double length = 2.0 * primitive->half_length_m();
    if (primitive->kind == core::PrimitiveKind::kCylinder)
      out.geometry = std::make_unique<fcl::Cylinder<double>>(radius, length);
    else
      out.geometry = std::make_unique<fcl::Capsule<double>>(radius, length);
    const core::Vec3 axis = core::axis_vector(primitive->axis, 1.0F);
    out.in_body.linear() =
        fcl::Quaternion<double>::FromTwoVectors(Vector::UnitZ(), Vector(axis.x, axis.y, axis.z)).toRotationMatrix();
  }
  return out;
}

// Normalized in double: a float quaternion is a unit only to 1e-7, and FCL takes the matrix as it is.
Transform shape_pose(const core::Pose& pose) {
  const core::Quat q = pose.orientation;
  Transform t = Transform::Identity();
  t.linear() = fcl::Quaternion<double>(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  t.translation() = Vector(pose.position.x, pose.position.y, pose.position.z);
  return t;
}

struct Placed {
  const fcl::CollisionGeometry<double>* geometry;
  Transform pose;
};

struct Query {
  bool is_signed = true;  // fcl::distance also where bodies overlap; without it, fcl::collide answers there
  fcl::GJKSolverType solver = fcl::GST_LIBCCD;
};

// The deepest of up to eight contacts; false when FCL finds none.
bool collide(const Placed& a, const Placed& b, const Query& query, Separation& out) {
  fcl::CollisionRequest<double> request(/*num_max_contacts_=*/8, /*enable_contact_=*/true);
  request.gjk_solver_type = query.solver;
  fcl::CollisionResult<double> touch;
  if (fcl::collide(a.geometry, a.pose, b.geometry, b.pose, request, touch) == 0) return false;
  double deepest = 0.0;
  for (std::size_t k = 0; k < touch.numContacts(); ++k) {
    const fcl::Contact<double>& contact = touch.getContact(k);
    if (k > 0 && contact.penetration_depth <= deepest) continue;
    deepest = contact.penetration_depth;
    out.normal = core_vector(-contact.normal);  // FCL's points from A to B
    out.witness_a = out.witness_b = core_vector(contact.pos);
  }
  out.is_touching = true;
  out.distance_m = -deepest;
  return true;
}

Separation measure_one(const Placed& a, const Placed& b, const Query& query) {
  Separation out;
  if (!query.is_signed && collide(a, b, query, out)) return out;
  fcl::DistanceRequest<double> request(/*enable_nearest_points_=*/true, query.is_signed);
  request.gjk_solver_type = query.solver;
  fcl::DistanceResult<double> near;
  fcl::distance(a.geometry, a.pose, b.geometry, b.pose, request, near);
  out.distance_m = near.min_distance;
  out.witness_a = core_vector(near.nearest_points[0]);
  out.witness_b = core_vector(near.nearest_points[1]);
  out.is_touching = near.min_distance <= 0.0;
  Vector from_b_to_a = near.nearest_points[0] - near.nearest_points[1];
  // In overlap the nearest points have passed each other. With the independent solver they do not lie on the surfaces
  // then, so the direction of its contact is used.
  if (out.is_touching && query.solver == fcl::GST_INDEP) {
    Separation contact;
    if (collide(a, b, query, contact)) out.normal = contact.normal;
    return out;
  }
  if (out.is_touching) from_b_to_a = -from_b_to_a;
  if (from_b_to_a.norm() > 0.0) out.normal = core_vector(from_b_to_a.normalized());
  return out;
}

class FclShapes final : public core::NarrowPhase {
 public:
  FclShapes(Query query, int workers) : query_(query), arena_(workers) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("fcl-shapes: load", [&]() -> Status {
      shapes_.clear();
      mesh_of_body_.clear();
      for (const auto& mesh : scene.meshes) {
        auto shape = shape_of(*mesh);
        if (!shape) return no_shape(kFclShapesId, *mesh);
        shapes_.push_back(std::move(*shape));
      }
      for (const core::Body& body : scene.bodies) mesh_of_body_.push_back(body.mesh);
      return core::Done{};
    });
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(kFclShapesId, pairs, poses, mesh_of_body_.size()); !status) return status;
    separations_.assign(pairs.size(), {});
    return vendor_call("fcl-shapes: measure", [&]() -> Status {
      arena_.execute([&] {
        tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
          separations_[k] = measure_one(place(pairs[k].i, poses), place(pairs[k].j, poses), query_);
        });
      });
      return core::Done{};
    });
  }

  core::Result<std::vector<Separation>> read_back() override { return separations_; }

 private:
  [[nodiscard]] Placed place(std::uint32_t body, std::span<const core::Pose> poses) const {
    const BodyShape& shape = shapes_[mesh_of_body_[body]];
    return {shape.geometry.get(), shape_pose(poses[body]) * shape.in_body};
  }

  Query query_;
  tbb::task_arena arena_;
  std::vector<BodyShape> shapes_;
  std::vector<std::uint32_t> mesh_of_body_;
  std::vector<Separation> separations_;
};

std::span<const core::SettingRow> fcl_shapes_settings() {
  static const std::array<core::SettingRow, 3> kSettings{{
      {"query",
       "distance",
       {"distance", "collide"},
       "distance: signed, by the solver; collide: depth and normal of the deepest contact where bodies overlap"},
      {"solver", "libccd", {"libccd", "indep"}, "FCL's GST_LIBCCD or GST_INDEP"},
      threads_setting(),
  }};
  return kSettings;
}

core::EquivalenceCard card_of(const core::Scene& scene, const Query& query, int workers) {
  core::EquivalenceCard card = fcl_card(workers);
  card.push_back({"shape margin", "none", ""});
  card.push_back({"tolerance", "1e-6 m, where its iterations stop", "none"});
  card.push_back({"solver", query.solver == fcl::GST_INDEP ? "GST_INDEP" : "GST_LIBCCD", ""});
  for (const auto& mesh : scene.meshes) {
    const auto shape = shape_of(*mesh);
    if (shape)
      card.push_back({"shape of " + mesh->name, shape->what,
                      shape->facet_gap_m > 0.0 ? "a mesh with facets inside that surface" : ""});
  }
  return card;
}

core::Result<core::Engine> make_fcl_shapes(const core::Settings& settings) {
  const Query query{settings.text("query") == "distance",
                    settings.text("solver") == "indep" ? fcl::GST_INDEP : fcl::GST_LIBCCD};
  const int workers = worker_count(settings.number("threads"));
  core::Engine engine;
  engine.id = kFclShapesId;
  engine.build = fcl_build();
  engine.settings = settings;
  engine.narrow_phase = std::make_unique<FclShapes>(query, workers);
  engine.equivalence = [query, workers](const core::Scene& scene) { return card_of(scene, query, workers); };
  return engine;
}

}  // namespace

core::EngineRow fcl_shapes_row() {
  return {.id = kFclShapesId,
          .capabilities = "narrow",
          .what = "FCL on boxes, spheres, capsules and convex meshes: signed distance with both of its solvers",
          .settings = fcl_shapes_settings(),
          .runs_in_child = true,
          .create = make_fcl_shapes,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
