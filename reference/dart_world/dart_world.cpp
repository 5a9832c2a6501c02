#include "reference/dart_world/dart_world.hpp"

#include <cmath>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/dart/DARTCollisionDetector.hpp>
#include <dart/collision/fcl/FCLCollisionDetector.hpp>
#include <dart/config.hpp>
#include <dart/constraint/BoxedLcpConstraintSolver.hpp>
#include <dart/constraint/ContactConstraint.hpp>
#include <dart/constraint/PgsBoxedLcpSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CapsuleShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/TranslationalJoint.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reference/loaded_library.hpp"
#include "reference/rigid_world/solid.hpp"
#include "reference/rigid_world/world_record.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

namespace dyn = dart::dynamics;
using core::Status;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// By default DART stops looking for contacts of the whole world at a thousand. This many are allowed for each body.
constexpr std::size_t kPointsOfABody = 64;

Vector3d eigen(plain::Vec v) {
  return {v.x, v.y, v.z};
}
plain::Vec vec(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Isometry3d pose(plain::Quaternion q, plain::Vec x) {
  Isometry3d out = Isometry3d::Identity();
  out.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  out.translation() = eigen(x);
  return out;
}

core::Result<dyn::ShapePtr> shape_of(const Solid& s, const std::string& scene) {
  const core::Vec3 half = s.half_extents;
  switch (s.kind) {
    case SolidKind::kBox:
      return dyn::ShapePtr(std::make_shared<dyn::BoxShape>(2.0 * Vector3d(half.x, half.y, half.z)));
    case SolidKind::kSphere:
      return dyn::ShapePtr(std::make_shared<dyn::SphereShape>(s.radius_m));
    case SolidKind::kCapsule:
      return dyn::ShapePtr(std::make_shared<dyn::CapsuleShape>(s.radius_m, 2.0 * s.half_length_m));
    case SolidKind::kCylinder:
      return dyn::ShapePtr(std::make_shared<dyn::CylinderShape>(s.radius_m, 2.0 * s.half_length_m));
    case SolidKind::kConvex:
    case SolidKind::kMesh:
      break;
  }
  return core::Error{"unsupported: " + s.what, scene, "dart-world has boxes, spheres, capsules and cylinders",
                     core::Exit::kMissing};
}

class DartWorld final : public core::Dynamics {
 public:
  explicit DartWorld(const DartOptions& options) : options_(options) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("dart-world: load", [&]() -> Status {
      scene_ = &scene;
      if (Status s = record_.load(scene); !s) return s;
      nodes_.clear();
      ids_.clear();
      world_ = dart::simulation::World::create("scene");
      world_->setTimeStep(scene.dt_s);
      const core::Vec3 g = scene.gravity_m_s2;
      world_->setGravity(Vector3d(g.x, g.y, g.z));
      set_solver();
      for (std::uint32_t i = 0; i < scene.body_count(); ++i)
        if (Status s = add_body(i); !s) return s;
      for (std::uint32_t face = 0; face < core::kFaceCount; ++face) add_face(face);
      return core::Done{};
    });
  }

  Status step(float dt_s) override {
    return vendor_call("dart-world: step", [&]() -> Status {
      record_.begin_step();
      world_->setTimeStep(dt_s);
      apply_wrenches();
      world_->step();
      read_states();
      read_points(dt_s);
      return core::Done{};
    });
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return record_.read_back(frame, level);
  }

  [[nodiscard]] std::uint32_t groups() const override {
    return bit(core::Group::kBodies) | bit(core::Group::kWideBodies) | bit(core::Group::kPoints);
  }

 private:
  void set_solver() {
    using namespace dart::constraint;
    auto solver = std::make_unique<BoxedLcpConstraintSolver>();
    if (!options_.is_dantzig) solver->setBoxedLcpSolver(std::make_shared<PgsBoxedLcpSolver>());
    if (options_.detector == DartDetector::kOwn) {
      solver->setCollisionDetector(dart::collision::DARTCollisionDetector::create());
    } else {
      const auto fcl = dart::collision::FCLCollisionDetector::create();
      if (options_.detector == DartDetector::kFclPrimitives)
        fcl->setPrimitiveShapeType(dart::collision::FCLCollisionDetector::PRIMITIVE);
      solver->setCollisionDetector(fcl);
    }
    solver->getCollisionOption().maxNumContacts = kPointsOfABody * (scene_->bodies.size() + 1);
    world_->setConstraintSolver(std::move(solver));
  }

  void add_shape(dyn::BodyNode* node, const dyn::ShapePtr& shape, const Isometry3d& place,
                 const core::Material& material, std::uint32_t id) {
    dyn::ShapeNode* out = node->createShapeNodeWith<dyn::CollisionAspect, dyn::DynamicsAspect>(shape);
    out->setRelativeTransform(place);
    // DART takes the smaller friction of two surfaces and the product of their restitutions.
    out->getDynamicsAspect()->setFrictionCoeff(material.mu_kinetic);
    out->getDynamicsAspect()->setRestitutionCoeff(std::sqrt(static_cast<double>(material.restitution)));
    ids_[out] = id;
  }

  Status add_body(std::uint32_t i) {
    const RigidStart& start = record_.bodies()[i];
    const Solid solid = solid_of(scene_->meshes[start.mesh]);
    auto shape = shape_of(solid, scene_->name);
    if (!shape) return shape.error();
    const RigidState& s = start.state;
    const auto skeleton = dyn::Skeleton::create("body " + std::to_string(i));
    dyn::BodyNode* node = nullptr;
    if (start.is_static) {
      node = weld(skeleton, pose(s.q, s.x));
    } else if (record_.turns()) {
      const auto made = skeleton->createJointAndBodyNodePair<dyn::FreeJoint>();
      node = made.second;
      made.first->setPositions(dyn::FreeJoint::convertToPositions(pose(s.q, s.x)));
      made.first->setAngularVelocity(eigen(s.w));
      made.first->setLinearVelocity(eigen(s.v));
    } else {
      const auto made = skeleton->createJointAndBodyNodePair<dyn::TranslationalJoint>();
      node = made.second;
      made.first->setTransformFromChildBodyNode(pose(s.q, {}).inverse());
      made.first->setPositions(eigen(s.x));
      made.first->setVelocities(eigen(s.v));
    }
    if (!start.is_static) {
      const auto& r = start.inertia.row;
      if (record_.turns())
        node->setInertia(dyn::Inertia(start.mass_kg, Vector3d::Zero(), moments(r)));
      else
        node->setInertia(dyn::Inertia(start.mass_kg, Vector3d::Zero(), Eigen::Matrix3d::Identity()));
    }
    const bool is_round = solid.kind == SolidKind::kCapsule || solid.kind == SolidKind::kCylinder;
    add_shape(node, shape.value(),
              pose(is_round ? turned_from_z(solid.axis) : plain::Quaternion{}, -1.0 * start.center_of_mass),
              start.material, i);
    nodes_.push_back(node);
    world_->addSkeleton(skeleton);
    return core::Done{};
  }

  static Eigen::Matrix3d moments(const std::array<plain::Vec, 3>& r) {
    Eigen::Matrix3d m;
    m << r[0].x, r[0].y, r[0].z, r[1].x, r[1].y, r[1].z, r[2].x, r[2].y, r[2].z;
    return m;
  }

  static dyn::BodyNode* weld(const dyn::SkeletonPtr& skeleton, const Isometry3d& at) {
    const auto made = skeleton->createJointAndBodyNodePair<dyn::WeldJoint>();
    made.first->setTransformFromParentBodyNode(at);
    skeleton->setMobile(false);
    return made.second;
  }

  // In DART, FCL has no contact between a half-space and DART's meshes: a face is a box outside of the domain, as thick
  // as the domain is long.
  void add_face(std::uint32_t face) {
    const core::Vec3 low = scene_->domain.min;
    const core::Vec3 size = scene_->domain.max - low;
    const double thick = std::max({size.x, size.y, size.z});
    const int axis = static_cast<int>(face / 2);
    Vector3d center(low.x + 0.5 * size.x, low.y + 0.5 * size.y, low.z + 0.5 * size.z);
    Vector3d sides(size.x + 2.0 * thick, size.y + 2.0 * thick, size.z + 2.0 * thick);
    center[axis] = face % 2 == 1 ? scene_->domain.max[axis] + 0.5 * thick : low[axis] - 0.5 * thick;
    sides[axis] = thick;
    const auto skeleton = dyn::Skeleton::create("face " + std::to_string(face));
    Isometry3d at = Isometry3d::Identity();
    at.translation() = center;
    add_shape(weld(skeleton, at), std::make_shared<dyn::BoxShape>(sides), Isometry3d::Identity(), scene_->face_material,
              core::kFirstFace + face);
    world_->addSkeleton(skeleton);
  }

  // DART forgets forces at the end of a step. A node's origin is its center of mass.
  void apply_wrenches() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const BodyWrench& w = record_.bodies()[i].wrench;
      if (w.is_none()) continue;
      nodes_[i]->addExtForce(eigen(w.force(record_.states()[i].q)));
      nodes_[i]->addExtTorque(eigen(w.torque(record_.states()[i].q)), false);
    }
  }

  void read_states() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (record_.bodies()[i].is_static) continue;
      const Isometry3d& at = nodes_[i]->getTransform();
      const Eigen::Quaterniond q(at.linear());
      record_.states()[i] = {vec(at.translation()), plain::normalized({q.w(), q.x(), q.y(), q.z()}),
                             vec(nodes_[i]->getCOMLinearVelocity()), vec(nodes_[i]->getAngularVelocity())};
    }
  }

  // DART's normal points from object 2 to object 1, and the force, constant over the step, acts on object 1.
  void read_points(double h) {
    for (const dart::collision::Contact& c : world_->getLastCollisionResult().getContacts()) {
      const auto id = [this](const dart::collision::CollisionObject* object) {
        return ids_.at(object->getShapeFrame());
      };
      record_.add_point(id(c.collisionObject1), id(c.collisionObject2), vec(c.point), vec(c.normal),
                        -c.penetrationDepth, h * vec(c.force));
    }
  }

  DartOptions options_;
  const core::Scene* scene_ = nullptr;
  WorldRecord record_;
  dart::simulation::WorldPtr world_;
  std::vector<dyn::BodyNode*> nodes_;
  std::unordered_map<const dyn::ShapeFrame*, std::uint32_t> ids_;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_dart_world(const DartOptions& options) {
  return std::make_unique<DartWorld>(options);
}

std::string dart_build() {
  // A static function that is compiled into libdart: the address of an inline function would be in this program.
  const auto address = reinterpret_cast<const void*>(&dart::constraint::ContactConstraint::getErrorReductionParameter);
  return std::string("DART ") + DART_VERSION + " (" + loaded_library(address) + "), double";
}

core::EquivalenceCard dart_card() {
  const auto address = reinterpret_cast<const void*>(&dart::constraint::ContactConstraint::getErrorReductionParameter);
  return library_card(dart_build(), address, "float64", "as its build has it", 1);
}

double dart_correction_rate() {
  return dart::constraint::ContactConstraint::getErrorReductionParameter();
}

double dart_correction_speed_m_s() {
  return dart::constraint::ContactConstraint::getMaxErrorReductionVelocity();
}

}  // namespace broadside::reference
