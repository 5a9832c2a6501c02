// Bullet's own simulation of the scene: btDiscreteDynamicsWorld with the dbvt broad phase and its sequential impulses.
#include "reference/bullet_world/bullet_world.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/method/frame_digest.hpp"
#include "core/scene/refuse_springs.hpp"
#include "reference/bullet_vectors.hpp"
#include "reference/bullet_world/contact_readout.hpp"
#include "reference/rigid_world/principal_axes.hpp"
#include "reference/rigid_world/rigid_start.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;
using reference::bullet;

btVector3 bullet(plain::Vec v) {
  return {static_cast<btScalar>(v.x), static_cast<btScalar>(v.y), static_cast<btScalar>(v.z)};
}
btQuaternion bullet(plain::Quaternion q) {
  return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
          static_cast<btScalar>(q.w)};
}

int flags_of(BulletGyroscopic gyroscopic) {
  switch (gyroscopic) {
    case BulletGyroscopic::kImplicitBody:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
    case BulletGyroscopic::kImplicitWorld:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
    case BulletGyroscopic::kExplicit:
      return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
    case BulletGyroscopic::kOff:
      break;
  }
  return 0;
}

// Bullet calls two global functions to combine surfaces. They are replaced for the length of one step by the scene's
// rules (core/material.hpp), applied to the one coefficient of friction that Bullet has.
class SceneRules {
 public:
  explicit SceneRules(bool apply) {
    if (!apply) return;
    gCalculateCombinedFrictionCallback = [](const btCollisionObject* a, const btCollisionObject* b) {
      return std::sqrt(a->getFriction() * b->getFriction());
    };
    gCalculateCombinedRestitutionCallback = [](const btCollisionObject* a, const btCollisionObject* b) {
      return std::max(a->getRestitution(), b->getRestitution());
    };
  }
  ~SceneRules() {
    gCalculateCombinedFrictionCallback = friction_;
    gCalculateCombinedRestitutionCallback = restitution_;
  }
  SceneRules(const SceneRules&) = delete;
  SceneRules& operator=(const SceneRules&) = delete;

 private:
  CalculateCombinedCallback friction_ = gCalculateCombinedFrictionCallback;
  CalculateCombinedCallback restitution_ = gCalculateCombinedRestitutionCallback;
};

// Members in the order in which Bullet's objects need each other.
struct World {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broad_phase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld dynamics{&dispatcher, &broad_phase, &solver, &configuration};
  std::vector<BulletShape> shapes;                        // one per mesh
  std::vector<std::unique_ptr<btCompoundShape>> shifted;  // for bodies whose center of mass or axes are not the mesh's
  std::vector<std::unique_ptr<btStaticPlaneShape>> planes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;  // the scene's, then the faces of its domain

  World() { btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  // Bullet looks through all its pairs for each body that it removes. Each face has a pair with every body, so the
  // faces are removed first; otherwise 100,000 bodies take minutes.
  ~World() {
    const std::size_t first_face = bodies.size() - std::min(bodies.size(), planes.size());
    for (std::size_t k = first_face; k < bodies.size(); ++k) dynamics.removeRigidBody(bodies[k].get());
    for (std::size_t k = 0; k < first_face; ++k) dynamics.removeRigidBody(bodies[k].get());
  }
};

class BulletWorld final : public core::Dynamics {
 public:
  explicit BulletWorld(BulletWorldOptions options) : options_(options) {}

  Status load(const core::Scene& scene) override {
    if (Status s = core::refuse_springs(scene); !s) return s;
    return vendor_call("bullet-world: load", [&]() -> Status {
      scene_ = &scene;
      step_ = 0;
      rotates_ = bullet_world_rotates(scene, options_);
      starts_.clear();
      wrenches_.clear();
      if (!scene.wrenches.empty())
        for (std::uint32_t i = 0; i < scene.body_count(); ++i)
          wrenches_.push_back(scene.bodies[i].inverse_mass > 0.0F ? wrench_on(scene, i) : BodyWrench{});
      if (scene.motion == core::Motion::kRigid) {
        auto starts = rigid_starts(scene);
        if (!starts) return starts.error();
        starts_ = std::move(starts).value();
      }
      body_from_mesh_.assign(scene.bodies.size(), btTransform::getIdentity());
      world_ = std::make_unique<World>();
      world_->dynamics.setGravity(bullet(scene.gravity_m_s2));
      btContactSolverInfo& info = world_->dynamics.getSolverInfo();
      info.m_numIterations = options_.iterations;
      if (!options_.warm_starting) info.m_solverMode &= ~SOLVER_USE_WARMSTARTING;
      if (options_.has_two_frictions) info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
      info.m_restitutionVelocityThreshold = scene.parameters.v_threshold_m_s;
      for (const auto& mesh : scene.meshes) world_->shapes.push_back(make_bullet_shape(mesh, options_.shapes));
      for (std::uint32_t i = 0; i < scene.body_count(); ++i) add_body(i);
      for (std::uint32_t face = 0; face < core::kFaceCount; ++face) add_face(face);
      before_.resize(scene.bodies.size());
      after_.resize(scene.bodies.size());
      turned_before_.resize(scene.bodies.size());
      read_states(after_);
      return core::Done{};
    });
  }

  Status step(float dt_s) override {
    return vendor_call("bullet-world: step", [&]() -> Status {
      std::swap(before_, after_);
      for (std::uint32_t i = 0; i < turned_before_.size(); ++i) turned_before_[i] = orientation(i);
      {
        const SceneRules rules(options_.uses_scene_rules);
        apply_wrenches();
        // No substeps: one step of exactly dt.
        world_->dynamics.stepSimulation(dt_s, 0);
      }
      read_states(after_);
      dt_s_ = dt_s;
      ++step_;
      return core::Done{};
    });
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return vendor_call("bullet-world: read_back", [&]() -> Status {
      frame = {};
      frame.step = step_;
      frame.time_s = static_cast<double>(step_) * scene_->dt_s;
      std::vector<core::Kinematics> seen = before_;  // positions at detection, velocities as the solver sees them
      for (std::size_t i = 0; i < seen.size(); ++i)
        if (scene_->bodies[i].inverse_mass > 0.0F) seen[i].v = seen[i].v + dt_s_ * scene_->gravity_m_s2;
      std::vector<core::Contact> contacts = read_contacts(world_->dispatcher, {seen, after_});
      for (std::uint32_t i = 0; i < scene_->body_count(); ++i)
        frame.digest += core::body_digest(i, after_[i].x, orientation(i), after_[i].v, angular_velocity(i));
      for (const core::Contact& c : contacts) frame.digest += core::contact_digest(c);
      if (level != core::RecordLevel::kFull) return core::Done{};
      for (std::uint32_t i = 0; i < scene_->body_count(); ++i) read_body(frame, i);
      read_pairs(frame);
      frame.contacts = std::move(contacts);
      if (options_.warm_starting) frame.points = read_points(world_->dispatcher);
      return core::Done{};
    });
  }

  [[nodiscard]] std::uint32_t groups() const override {
    const std::uint32_t always = bit(core::Group::kBodies) | bit(core::Group::kDetection) | bit(core::Group::kPairs) |
                                 bit(core::Group::kContacts) | bit(core::Group::kDetectedOrientation);
    return options_.warm_starting ? always | bit(core::Group::kPoints) : always;
  }

 private:
  void add_body(std::uint32_t i) {
    const core::Body& given = scene_->bodies[i];
    btCollisionShape* shape = world_->shapes[given.mesh].shape.get();
    const btScalar mass = given.inverse_mass > 0.0F ? 1.0F / given.inverse_mass : 0.0F;
    btVector3 inertia(0, 0, 0);
    if (mass > 0 && rotates_) shape->calculateLocalInertia(mass, inertia);
    if (mass > 0 && !starts_.empty()) shape = shape_about_mass(i, shape, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
    const btTransform of_mesh = bullet_transform(given.position, given.orientation);
    info.m_startWorldTransform = is_shifted(i) ? of_mesh * body_from_mesh_[i].inverse() : of_mesh;
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity(bullet(given.velocity));
    if (rotates_) body->setAngularVelocity(bullet(given.angular_velocity));
    if (!rotates_) body->setAngularFactor(0);
    body->setFlags(flags_of(options_.gyroscopic));
    // The scene has no sleeping: a body at rest is still simulated.
    body->setActivationState(DISABLE_DEACTIVATION);
    add(std::move(body), given.material, i);
  }

  // Bullet's bodies are placed by their center of mass, in axes in which the inertia is diagonal. Where these are not
  // the mesh's, the shape becomes the child of a compound. Writes the principal moments to `inertia`.
  btCollisionShape* shape_about_mass(std::uint32_t i, btCollisionShape* shape, btVector3& inertia) {
    const RigidStart& start = starts_[i];
    const PrincipalAxes axes = principal_axes(start.inertia);
    inertia = bullet(axes.moments);
    const plain::Vec c = start.center_of_mass;
    if (!axes.is_turned && plain::dot(c, c) == 0.0) return shape;
    body_from_mesh_[i] = btTransform(bullet(axes.q), bullet(c)).inverse();
    auto compound = std::make_unique<btCompoundShape>(false, 1);
    compound->setMargin(shape->getMargin());
    compound->addChildShape(body_from_mesh_[i], shape);
    world_->shifted.push_back(std::move(compound));
    return world_->shifted.back().get();
  }

  [[nodiscard]] bool is_shifted(std::size_t i) const { return !(body_from_mesh_[i] == btTransform::getIdentity()); }

  [[nodiscard]] btTransform mesh_transform(std::size_t i) const {
    const btTransform& of_body = world_->bodies[i]->getWorldTransform();
    return is_shifted(i) ? of_body * body_from_mesh_[i] : of_body;
  }

  void add_face(std::uint32_t face) {
    const int axis = static_cast<int>(face / 2);
    const bool is_upper = face % 2 == 1;
    const float wall = is_upper ? -scene_->domain.max[axis] : scene_->domain.min[axis];
    world_->planes.push_back(
        std::make_unique<btStaticPlaneShape>(bullet(core::axis_vector(axis, is_upper ? -1.0F : 1.0F)), wall));
    const btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, world_->planes.back().get());
    add(std::make_unique<btRigidBody>(info), scene_->face_material, core::kFirstFace + face);
  }

  void add(std::unique_ptr<btRigidBody> body, const core::Material& material, std::uint32_t id) {
    body->setFriction(material.mu_kinetic);
    body->setRestitution(material.restitution);
    body->setUserIndex(static_cast<int>(id));
    world_->dynamics.addRigidBody(body.get());
    world_->bodies.push_back(std::move(body));
  }

  // Bullet forgets forces at the end of a step.
  void apply_wrenches() {
    for (std::uint32_t i = 0; i < wrenches_.size(); ++i) {
      if (wrenches_[i].is_none()) continue;
      const core::Quat at = orientation(i);
      const plain::Quaternion q = plain::normalized({at.w, at.x, at.y, at.z});
      world_->bodies[i]->applyCentralForce(bullet(wrenches_[i].force(q)));
      world_->bodies[i]->applyTorque(bullet(wrenches_[i].torque(q)));
    }
  }

  void read_states(std::vector<core::Kinematics>& states) const {
    for (std::size_t i = 0; i < states.size(); ++i) {
      const btRigidBody& body = *world_->bodies[i];
      states[i] = {to_core(mesh_transform(i).getOrigin()), to_core(body.getLinearVelocity())};
    }
  }

  // A body that only translates keeps the quaternion that it was given, bit for bit: Bullet holds a matrix.
  [[nodiscard]] core::Quat orientation(std::uint32_t i) const {
    if (!rotates_) return scene_->bodies[i].orientation;
    return to_core(mesh_transform(i).getRotation());
  }

  [[nodiscard]] core::Vec3 angular_velocity(std::uint32_t i) const {
    return rotates_ ? to_core(world_->bodies[i]->getAngularVelocity()) : core::Vec3{};
  }

  void read_body(core::FrameRecord& frame, std::uint32_t i) const {
    frame.position.push_back(after_[i].x);
    frame.velocity.push_back(after_[i].v);
    frame.orientation.push_back(orientation(i));
    frame.angular_velocity.push_back(angular_velocity(i));
    // Bullet detects at the start of a step and moves bodies at its end.
    frame.detected_position.push_back(before_[i].x);
    frame.detected_velocity.push_back(before_[i].v);
    frame.detected_orientation.push_back(turned_before_[i]);
    const btBroadphaseProxy* proxy = world_->bodies[i]->getBroadphaseProxy();
    frame.boxes.push_back({to_core(proxy->m_aabbMin), to_core(proxy->m_aabbMax)});
  }

  // Bullet's cache, without the faces, filtered on the boxes that its broad phase was given.
  void read_pairs(core::FrameRecord& frame) {
    const btBroadphasePairArray& cache = world_->broad_phase.getOverlappingPairCache()->getOverlappingPairArray();
    const auto body_of = [](const btBroadphaseProxy* proxy) {
      return static_cast<std::uint32_t>(static_cast<btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
    };
    for (int k = 0; k < cache.size(); ++k) {
      const core::Pair pair = core::make_pair_of(body_of(cache[k].m_pProxy0), body_of(cache[k].m_pProxy1));
      if (core::is_face(pair.j)) continue;
      ++frame.pairs_raw;
      if (core::overlaps(frame.boxes[pair.i], frame.boxes[pair.j])) frame.pairs.push_back(pair);
    }
    std::sort(frame.pairs.begin(), frame.pairs.end());
    frame.pairs_demanded = frame.pairs.size();
  }

  BulletWorldOptions options_;
  const core::Scene* scene_ = nullptr;
  bool rotates_ = false;
  std::unique_ptr<World> world_;
  std::vector<RigidStart> starts_;           // for scenes whose bodies turn
  std::vector<BodyWrench> wrenches_;         // by body; none where the scene has none
  std::vector<btTransform> body_from_mesh_;  // pose of the mesh in the body's principal axes
  std::vector<core::Quat> turned_before_;
  std::vector<core::Kinematics> before_;
  std::vector<core::Kinematics> after_;
  std::uint64_t step_ = 0;
  float dt_s_ = 0.0F;
};

}  // namespace

bool bullet_world_rotates(const core::Scene& scene, const BulletWorldOptions& options) {
  return options.always_rotates || scene.motion == core::Motion::kRigid ||
         std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const core::Body& b) { return !(b.angular_velocity == core::Vec3{}); });
}

std::unique_ptr<core::Dynamics> make_bullet_world(const BulletWorldOptions& options) {
  return std::make_unique<BulletWorld>(options);
}

}  // namespace broadside::reference
