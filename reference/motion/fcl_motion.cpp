// FCL's continuousCollide on bodies: with its motions and its solvers, on shapes and on meshes.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/RSS.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/screw_motion.h>
#include <fcl/math/motion/spline_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/scene/primitive.hpp"
#include "reference/motion/motion_engines.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using Vector = fcl::Vector3<double>;
using Matrix = fcl::Matrix3<double>;
using Transform = fcl::Transform3<double>;
using Geometry = fcl::CollisionGeometry<double>;
using Motion = fcl::MotionBase<double>;
using RssModel = fcl::BVHModel<fcl::RSS<double>>;

enum class Path { kLinear, kTranslation, kScrew, kSpline };

// Bounding volumes: RSS, the only ones for which FCL's advancement on meshes is meant.
std::unique_ptr<Geometry> mesh_geometry(const core::Mesh& mesh, const Transform& pose) {
  std::vector<Vector> vertices;
  for (const core::Vec3 v : mesh.vertices) vertices.push_back(pose * Vector(v.x, v.y, v.z));
  std::vector<fcl::Triangle> triangles;
  for (const core::Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_unique<RssModel>();
  const bool is_built =
      model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size())) == fcl::BVH_OK &&
      model->addSubModel(vertices, triangles) == fcl::BVH_OK && model->endModel() == fcl::BVH_OK;
  if (!is_built) throw std::runtime_error("BVHModel could not be built for mesh '" + mesh.name + "'");
  model->computeLocalAABB();
  return model;
}

std::unique_ptr<Geometry> convex_geometry(const core::Mesh& mesh) {
  auto vertices = std::make_shared<std::vector<Vector>>();
  for (const core::Vec3 v : mesh.vertices) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const core::Triangle& t : mesh.triangles) {
    faces->push_back(3);
    for (const std::uint32_t v : t) faces->push_back(static_cast<int>(v));
  }
  return std::make_unique<fcl::Convex<double>>(vertices, static_cast<int>(mesh.triangles.size()), faces, true);
}

struct Shape {
  std::unique_ptr<Geometry> geometry;
  Matrix in_body = Matrix::Identity();  // FCL's capsules lie along z
};

core::Result<Shape> shape_of(const core::Mesh& mesh, bool as_mesh) {
  Shape out;
  const auto primitive = core::primitive_of(mesh);
  if (as_mesh) {
    out.geometry = mesh_geometry(mesh, Transform::Identity());
  } else if (!primitive && !core::is_convex(mesh)) {
    return core::Error{"mesh '" + mesh.name + "' is no box, sphere, capsule or convex body", "fcl-motion",
                       "ask with shape=mesh", core::Exit::kMissing};
  } else if (!primitive) {
    out.geometry = convex_geometry(mesh);
  } else if (primitive->kind == core::PrimitiveKind::kBox) {
    const core::Vec3 half = primitive->half_extents;
    out.geometry = std::make_unique<fcl::Box<double>>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
  } else if (primitive->kind == core::PrimitiveKind::kSphere) {
    out.geometry = std::make_unique<fcl::Sphere<double>>(primitive->radius_m);
  } else {
    out.geometry = std::make_unique<fcl::Capsule<double>>(primitive->radius_m, 2.0 * primitive->half_length_m());
    const core::Vec3 axis = core::axis_vector(primitive->axis, 1.0F);
    out.in_body =
        fcl::Quaternion<double>::FromTwoVectors(Vector::UnitZ(), Vector(axis.x, axis.y, axis.z)).toRotationMatrix();
  }
  out.geometry->computeLocalAABB();
  return out;
}

Transform transform(const exact::RigidMotion& motion, const Shape& shape, double t) {
  const exact::Placement at = placement_at(motion, t);
  const auto [w, x, y, z] = at.orientation;
  Transform out = Transform::Identity();
  out.linear() = fcl::Quaternion<double>(w, x, y, z).normalized().toRotationMatrix() * shape.in_body;
  out.translation() = Vector(at.origin.x, at.origin.y, at.origin.z);
  return out;
}

std::unique_ptr<Motion> make_motion(Path path, const Transform& from, const Transform& to) {
  switch (path) {
    case Path::kTranslation:
      return std::make_unique<fcl::TranslationMotion<double>>(from, to);
    case Path::kScrew:
      return std::make_unique<fcl::ScrewMotion<double>>(from, to);
    case Path::kSpline: {
      // Equidistant control points are a straight line at constant speed. The constructor from two transforms is empty.
      const Vector step = to.translation() - from.translation();
      const fcl::AngleAxis<double> turn(from.linear());
      const Vector r = turn.angle() * turn.axis();
      const Vector p = from.translation();
      return std::make_unique<fcl::SplineMotion<double>>(p - step, p, p + step, p + 2.0 * step, r, r, r, r);
    }
    case Path::kLinear:
      break;
  }
  // The constructor without a reference point leaves that member uninitialized.
  return std::make_unique<fcl::InterpMotion<double>>(from.linear(), from.translation(), to.linear(), to.translation(),
                                                     Vector(0.0, 0.0, 0.0));
}

struct MotionOptions {
  Path path = Path::kLinear;
  bool as_mesh = false;
  fcl::ContinuousCollisionRequest<double> request;
};

class Bodies final : public core::BodyMotionQuery {
 public:
  explicit Bodies(const MotionOptions& query) : query_(query) {}

  core::Status load(std::span<const std::shared_ptr<const core::Mesh>> meshes) override {
    meshes_.assign(meshes.begin(), meshes.end());
    return vendor_call("fcl-motion: load", [&]() -> core::Status {
      shapes_.clear();
      for (const auto& mesh : meshes_) {
        auto shape = shape_of(*mesh, query_.as_mesh);
        if (!shape) return shape.error();
        shapes_.push_back(std::move(shape).value());
      }
      return core::Done{};
    });
  }

  // A screw that only turns is a turn about the body's origin, one that only moves a straight line.
  [[nodiscard]] bool follows(const exact::RigidMotion& motion) const override {
    const bool turns = length(motion.rotation_rad) > 0.0;
    const bool moves = length(motion.displacement_m) > 0.0;
    if (query_.path == Path::kLinear) return true;
    return query_.path == Path::kScrew ? !turns || !moves : !turns;
  }

  core::Result<core::FirstTouch> first_touch(const core::MovingBody& a, const core::MovingBody& b) override {
    return vendor_call("fcl-motion: first touch", [&]() -> core::Result<core::FirstTouch> {
      fcl::ContinuousCollisionResult<double> result;
      const double said =
          query_.request.ccd_solver_type == fcl::CCDC_POLYNOMIAL_SOLVER ? ask_placed(a, b, result) : ask(a, b, result);
      if (said == -1.0) throw std::runtime_error("it refuses these shapes with this solver");
      return core::FirstTouch{result.is_collide, result.is_collide ? result.time_of_contact : 1.0};
    });
  }

 private:
  [[nodiscard]] std::unique_ptr<Motion> motion_of(const core::MovingBody& body, const Shape& shape) const {
    return make_motion(query_.path, transform(body.motion, shape, 0.0), transform(body.motion, shape, 1.0));
  }

  double ask(const core::MovingBody& a, const core::MovingBody& b, fcl::ContinuousCollisionResult<double>& result) {
    const auto motion_a = motion_of(a, shapes_[a.mesh]);
    const auto motion_b = motion_of(b, shapes_[b.mesh]);
    return fcl::continuousCollide<double>(shapes_[a.mesh].geometry.get(), motion_a.get(),
                                          shapes_[b.mesh].geometry.get(), motion_b.get(), query_.request, result);
  }

  // The polynomial solver ignores poses and moves the models' own vertices. So each query gets models of its own whose
  // vertices are where they are at the start.
  double ask_placed(const core::MovingBody& a, const core::MovingBody& b,
                    fcl::ContinuousCollisionResult<double>& result) {
    const auto placed = [&](const core::MovingBody& body) {
      return mesh_geometry(*meshes_[body.mesh], transform(body.motion, Shape{}, 0.0));
    };
    const auto way = [](const core::MovingBody& body) {
      const exact::Point d = body.motion.displacement_m;
      return fcl::TranslationMotion<double>(Matrix::Identity(), Vector(0.0, 0.0, 0.0), Vector(d.x, d.y, d.z));
    };
    const auto model_a = placed(a);
    const auto model_b = placed(b);
    const auto motion_a = way(a);
    const auto motion_b = way(b);
    return fcl::continuousCollide<double>(model_a.get(), &motion_a, model_b.get(), &motion_b, query_.request, result);
  }

  MotionOptions query_;
  std::vector<std::shared_ptr<const core::Mesh>> meshes_;
  std::vector<Shape> shapes_;
};

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 5> kSettings{{
      {"motion",
       "linear",
       {"linear", "translation", "screw", "spline"},
       "InterpMotion, TranslationMotion, ScrewMotion or SplineMotion; all but the first only where they move bodies "
       "alike"},
      {"solver",
       "advancement",
       {"advancement", "naive", "polynomial"},
       "conservative advancement, samples of the step, or cubic equations of a translated mesh's features"},
      {"gjk", "libccd", {"libccd", "indep"}, "with advancement and naive: FCL's GST_LIBCCD or GST_INDEP"},
      {"samples", "10", {}, "with naive: samples of the step; FCL's default is 10"},
      {"shape", "solid", {"solid", "mesh"}, "primitives and convex bodies, or triangles under RSS"},
  }};
  return kSettings;
}

core::Result<core::MotionEngine> create(const core::Settings& settings) {
  MotionOptions query;
  const std::string& motion = settings.text("motion");
  query.path = motion == "translation" ? Path::kTranslation
               : motion == "screw"     ? Path::kScrew
               : motion == "spline"    ? Path::kSpline
                                       : Path::kLinear;
  query.as_mesh = settings.text("shape") == "mesh";
  const std::string& solver = settings.text("solver");
  query.request.ccd_solver_type = solver == "naive"        ? fcl::CCDC_NAIVE
                                  : solver == "polynomial" ? fcl::CCDC_POLYNOMIAL_SOLVER
                                                           : fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
  query.request.gjk_solver_type = settings.text("gjk") == "indep" ? fcl::GST_INDEP : fcl::GST_LIBCCD;
  query.request.num_max_iterations = settings.number("samples");
  query.request.ccd_motion_type = query.path == Path::kTranslation ? fcl::CCDM_TRANS : fcl::CCDM_LINEAR;
  if (solver == "naive" && query.request.num_max_iterations < 2)
    return core::Error{"samples=" + settings.text("samples") + " is too few", "fcl-motion", "give at least 2"};
  if (solver == "polynomial" && (query.path != Path::kTranslation || !query.as_mesh))
    return core::Error{"solver=polynomial knows only meshes that translate", "fcl-motion",
                       "add motion=translation,shape=mesh"};
  // As many samples as asked for: FCL takes no more than 1 / toc_err.
  if (solver == "naive") query.request.toc_err = 0.5 / static_cast<double>(query.request.num_max_iterations);
  core::MotionEngine engine;
  engine.id = "fcl-motion";
  engine.build = fcl_build();
  engine.settings = settings;
  engine.bodies = std::make_unique<Bodies>(query);
  return engine;
}

}  // namespace

core::MotionEngineRow fcl_motion_row() {
  return {"fcl-motion", "FCL's continuousCollide: shapes and meshes, each of its motions and solvers", setting_rows(),
          create};
}

}  // namespace broadside::reference
