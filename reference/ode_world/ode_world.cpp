#include "reference/ode_world/ode_world.hpp"

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "reference/ode_world/ode_library.hpp"
#include "reference/ode_world/ode_shapes.hpp"
#include "reference/rigid_world/world_record.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;
using plain::Vec;

// The most points for two geoms; ODE drops further ones. Its own demos take 8 for boxes and 64 for meshes.
constexpr int kMostPoints = 64;
// The inertia of a body that only translates: its inverse is zero in any precision.
constexpr double kNeverTurns = 1e200;

Vec vec(const dReal* v) {
  return {v[0], v[1], v[2]};
}
void set(dReal (&out)[4], plain::Quaternion q) {
  out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
}
plain::Quaternion product(plain::Quaternion p, plain::Quaternion q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
}

// ODE's step divides by the length of normals, so the length must not be zero.
bool is_usable(const dContactGeom& c) {
  const auto squared = [](const dReal* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
  return std::isfinite(squared(c.pos)) && std::isfinite(c.depth) && std::abs(squared(c.normal) - 1.0) < 0.5;
}

core::Box rounded_outward(const dReal* box) {
  const auto down = [](double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
  };
  const auto up = [](double v) {
    const auto f = static_cast<float>(v);
    return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
  };
  return {{down(box[0]), down(box[2]), down(box[4])}, {up(box[1]), up(box[3]), up(box[5])}};
}

// Owns what ODE made for one scene.
struct World {
  std::vector<OdeShape> shapes;  // one per mesh; geoms refer to them
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  dJointGroupID joints = dJointGroupCreate(0);
  std::vector<dBodyID> bodies;  // null for static bodies
  std::vector<dGeomID> geoms;
  std::array<dGeomID, core::kFaceCount> faces{};

  World() = default;
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    dJointGroupDestroy(joints);
    for (const dGeomID face : faces)
      if (face != nullptr) dGeomDestroy(face);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
};

// A contact joint of this step, and where ODE will write its forces.
struct Touch {
  std::uint32_t first = 0;  // the body that moves, ODE's body 1
  std::uint32_t second = 0;
  dContactGeom at{};
  dJointFeedback feedback{};
};

class OdeWorld final : public core::Dynamics {
 public:
  OdeWorld(const OdeOptions& options, SharedDefectCounter lcp) : options_(options), lcp_(std::move(lcp)) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("ode-world: load", [&]() -> Status {
      enter_ode();
      scene_ = &scene;
      if (Status s = record_.load(scene); !s) return s;
      touches_.clear();
      seed_ = 0;
      world_ = std::make_unique<World>();
      const core::Vec3 g = scene.gravity_m_s2;
      dWorldSetGravity(world_->world, g.x, g.y, g.z);
      dWorldSetQuickStepNumIterations(world_->world, options_.iterations);
      dWorldSetContactSurfaceLayer(world_->world, options_.surface_layer_m);
      for (const auto& mesh : scene.meshes) world_->shapes.push_back(make_ode_shape(mesh, options_.convex_as_mesh));
      for (std::uint32_t i = 0; i < scene.body_count(); ++i) add_body(i);
      for (std::uint32_t face = 0; face < core::kFaceCount; ++face) add_face(face);
      return core::Done{};
    });
  }

  Status step(float dt_s) override {
    return vendor_call("ode-world: step", [&]() -> Status {
      enter_ode();
      record_.begin_step();
      collide();
      if (!strange_.empty())
        return core::Error{strange_, "ode-world: step", "see the engine's known defects in reference/README.md",
                           core::Exit::kMissing};
      apply_wrenches();
      forget_lcp_errors();
      // QuickStep reorders constraints by a random number whose seed is the whole process's.
      dRandSetSeed(seed_);
      const int is_done = options_.is_quick ? dWorldQuickStep(world_->world, dt_s) : dWorldStep(world_->world, dt_s);
      seed_ = dRandGetSeed();
      lcp_->note(ode_lcp_errors() > 0 ? 1 : 0, 1);
      if (is_done == 0)
        return core::Error{"ODE had no memory for this step", "ode-world: step", "run a smaller scene",
                           core::Exit::kMissing};
      read_states();
      read_points(dt_s);
      dJointGroupEmpty(world_->joints);
      return core::Done{};
    });
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return record_.read_back(frame, level);
  }

  [[nodiscard]] std::uint32_t groups() const override {
    return bit(core::Group::kBodies) | bit(core::Group::kWideBodies) | bit(core::Group::kDetection) |
           bit(core::Group::kDetectedOrientation) | bit(core::Group::kPoints);
  }

 private:
  void add_body(std::uint32_t i) {
    const RigidStart& start = record_.bodies()[i];
    const RigidState& s = start.state;
    const OdeShape& shape = world_->shapes[start.mesh];
    const dGeomID geom = make_geom(shape, world_->space);
    dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::uintptr_t>(i)));  // NOLINT(performance-no-int-to-ptr)
    world_->geoms.push_back(geom);
    const Vec offset = shape.origin - start.center_of_mass;
    if (start.is_static) {
      const Vec at = s.x + plain::matrix(s.q) * offset;
      dQuaternion q;
      set(q, product(s.q, shape.q));
      dGeomSetPosition(geom, at.x, at.y, at.z);
      dGeomSetQuaternion(geom, q);
      world_->bodies.push_back(nullptr);
      return;
    }
    const dBodyID body = dBodyCreate(world_->world);
    dMass mass;
    const auto& r = start.inertia.row;
    if (record_.turns())
      dMassSetParameters(&mass, start.mass_kg, 0, 0, 0, r[0].x, r[1].y, r[2].z, r[0].y, r[0].z, r[1].z);
    else
      dMassSetParameters(&mass, start.mass_kg, 0, 0, 0, kNeverTurns, kNeverTurns, kNeverTurns, 0, 0, 0);
    dBodySetMass(body, &mass);
    dBodySetGyroscopicMode(body, options_.has_gyroscopic && record_.turns() ? 1 : 0);
    dBodySetPosition(body, s.x.x, s.x.y, s.x.z);
    dQuaternion q;
    set(q, s.q);
    dBodySetQuaternion(body, q);
    dBodySetLinearVel(body, s.v.x, s.v.y, s.v.z);
    dBodySetAngularVel(body, s.w.x, s.w.y, s.w.z);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, offset.x, offset.y, offset.z);
    set(q, shape.q);
    dGeomSetOffsetQuaternion(geom, q);
    world_->bodies.push_back(body);
  }

  void add_face(std::uint32_t face) {
    const std::size_t axis = face / 2;
    const bool is_upper = face % 2 == 1;
    std::array<double, 3> n{};
    n[axis] = is_upper ? -1.0 : 1.0;
    const core::Box& d = scene_->domain;
    const double offset = is_upper ? -d.max[static_cast<int>(axis)] : d.min[static_cast<int>(axis)];
    // Planes are created outside of the space: a plane's box is infinite, so every body would be its neighbor.
    world_->faces[face] = dCreatePlane(nullptr, n[0], n[1], n[2], offset);
  }

  // ODE forgets forces at the end of a step.
  void apply_wrenches() {
    for (std::size_t i = 0; i < world_->bodies.size(); ++i) {
      const BodyWrench& w = record_.bodies()[i].wrench;
      if (w.is_none()) continue;
      const Vec force = w.force(record_.states()[i].q);
      const Vec torque = w.torque(record_.states()[i].q);
      dBodyAddForce(world_->bodies[i], force.x, force.y, force.z);
      dBodyAddTorque(world_->bodies[i], torque.x, torque.y, torque.z);
    }
  }

  void collide() {
    touches_.clear();
    dSpaceCollide(world_->space, this, [](void* self, dGeomID a, dGeomID b) {
      const auto body_of = [](dGeomID geom) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
      };
      static_cast<OdeWorld*>(self)->touch(body_of(a), body_of(b));
    });
    std::vector<core::Box> boxes;
    boxes.reserve(world_->geoms.size());
    for (std::uint32_t i = 0; i < world_->geoms.size(); ++i) {
      dReal box[6];
      dGeomGetAABB(world_->geoms[i], box);
      boxes.push_back(rounded_outward(box));
      if (world_->bodies[i] == nullptr) continue;
      for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
        const int axis = static_cast<int>(face / 2);
        const bool is_near = face % 2 == 1 ? boxes.back().max[axis] >= scene_->domain.max[axis]
                                           : boxes.back().min[axis] <= scene_->domain.min[axis];
        if (is_near)
          add_touches(i, core::kFirstFace + face, world_->geoms[i], world_->faces[face], scene_->face_material);
      }
    }
    record_.set_boxes(std::move(boxes));
  }

  void touch(std::uint32_t a, std::uint32_t b) {
    if (world_->bodies[a] == nullptr && world_->bodies[b] == nullptr) return;
    if (a > b) std::swap(a, b);
    if (world_->bodies[a] == nullptr) std::swap(a, b);  // a joint's first body is one that moves
    add_touches(a, b, world_->geoms[a], world_->geoms[b], record_.bodies()[b].material);
  }

  void add_touches(std::uint32_t first, std::uint32_t second, dGeomID a, dGeomID b, const core::Material& other) {
    std::array<dContactGeom, kMostPoints> points;
    const int count = dCollide(a, b, kMostPoints, points.data(), sizeof(dContactGeom));
    const core::Material surface = core::combine(record_.bodies()[first].material, other);
    for (int k = 0; k < count; ++k) {
      dContact contact{};
      contact.geom = points[static_cast<std::size_t>(k)];
      // A step with such a point ends in states that are no numbers, or in an assertion that names no body.
      if (!is_usable(contact.geom)) {
        strange_ = "dCollide gave a point of contact without a direction, between body " + std::to_string(first) +
                   " and " + (core::is_face(second) ? "a face" : "body " + std::to_string(second));
        return;
      }
      // Without dContactApprox1 mu would be a force, not a coefficient.
      contact.surface.mode = dContactApprox1 | dContactBounce;
      contact.surface.mu = surface.mu_kinetic;
      contact.surface.bounce = surface.restitution;
      contact.surface.bounce_vel = scene_->parameters.v_threshold_m_s;
      const dJointID joint = dJointCreateContact(world_->world, world_->joints, &contact);
      dJointAttach(joint, world_->bodies[first], core::is_face(second) ? nullptr : world_->bodies[second]);
      touches_.push_back({first, second, contact.geom, {}});
      dJointSetFeedback(joint, &touches_.back().feedback);
    }
  }

  void read_states() {
    for (std::size_t i = 0; i < world_->bodies.size(); ++i) {
      const dBodyID body = world_->bodies[i];
      if (body == nullptr) continue;
      const dReal* q = dBodyGetQuaternion(body);
      record_.states()[i] = {vec(dBodyGetPosition(body)),
                             {q[0], q[1], q[2], q[3]},
                             vec(dBodyGetLinearVel(body)),
                             vec(dBodyGetAngularVel(body))};
    }
  }

  // ODE's normal points into geom 1, the first body, and its feedback holds the force of the whole step on it.
  void read_points(double h) {
    for (const Touch& t : touches_)
      record_.add_point(t.first, t.second, vec(t.at.pos), vec(t.at.normal), -t.at.depth, h * vec(t.feedback.f1));
  }

  OdeOptions options_;
  SharedDefectCounter lcp_;
  const core::Scene* scene_ = nullptr;
  WorldRecord record_;
  std::unique_ptr<World> world_;
  std::deque<Touch> touches_;  // a deque, so addresses stay valid while it grows
  std::string strange_;        // the contact, found by ODE, with which no step can begin
  unsigned long seed_ = 0;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_ode_world(const OdeOptions& options, SharedDefectCounter lcp) {
  return std::make_unique<OdeWorld>(options, std::move(lcp));
}

}  // namespace broadside::reference
