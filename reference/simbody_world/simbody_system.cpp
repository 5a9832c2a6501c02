#include "reference/simbody_world/simbody_system.hpp"

#include <Simbody.h>

namespace broadside::reference {
namespace {

using SimTK::Rotation;
using SimTK::Transform;
using SimTK::Vec3;

Vec3 simbody(plain::Vec v) {
  return {v.x, v.y, v.z};
}
plain::Vec vec(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Rotation simbody(plain::Quaternion q) {
  return Rotation(SimTK::Quaternion(q.w, q.x, q.y, q.z));
}

SimTK::ContactMaterial material(double stiffness_pa, const SimbodySurface& s) {
  return {stiffness_pa, s.dissipation_s_m, s.mu_static, s.mu_kinetic, 0.0};
}

SimTK::ContactGeometry geometry(const SimbodyBody& b) {
  if (b.radius_m > 0.0) return SimTK::ContactGeometry::Sphere(b.radius_m);
  return SimTK::ContactGeometry::Brick(simbody(b.half_extents));
}

SimTK::Inertia inertia(const plain::Mat& m) {
  return {m.row[0].x, m.row[1].y, m.row[2].z, m.row[0].y, m.row[0].z, m.row[1].z};
}

// Applies the scene's wrenches to one body at every stage of the integrator, so that a force in the body's axes turns
// with the body.
class Wrench : public SimTK::Force::Custom::Implementation {
 public:
  Wrench(SimTK::MobilizedBody body, const SimbodyBody& given) : body_(std::move(body)), given_(given) {}

  void calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& forces, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    const Rotation& r = body_.getBodyRotation(state);
    const Vec3 torque = simbody(given_.torque_world) + r * simbody(given_.torque_body);
    const Vec3 force = simbody(given_.force_world) + r * simbody(given_.force_body);
    forces[body_.getMobilizedBodyIndex()] += SimTK::SpatialVec(torque, force);
  }

  // Simbody calls this where a user asks for energies, which does not happen here.
  SimTK::Real calcPotentialEnergy(const SimTK::State&) const override { return 0.0; }

 private:
  SimTK::MobilizedBody body_;
  SimbodyBody given_;
};

bool has_wrench(const SimbodyBody& b) {
  const plain::Vec all[] = {b.force_world, b.force_body, b.torque_world, b.torque_body};
  for (const plain::Vec v : all)
    if (v.x != 0.0 || v.y != 0.0 || v.z != 0.0) return true;
  return false;
}

}  // namespace

// Members in the order in which Simbody's objects need each other.
struct SimbodySystem::World {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  SimTK::GeneralForceSubsystem forces{system};
  SimTK::ContactTrackerSubsystem tracker{system};
  SimTK::CompliantContactSubsystem contact{system, tracker};
  std::vector<SimTK::MobilizedBody> bodies;  // ground for static ones
  std::unique_ptr<SimTK::RungeKuttaMersonIntegrator> integrator;
  std::unique_ptr<SimTK::TimeStepper> stepper;

  // Simbody's half-space is where x > 0 in its own axes: x points out of the domain.
  void add(const SimbodySetup::Face& face, const SimTK::ContactMaterial& surface) {
    Vec3 at(0);
    at[face.axis] = face.at_m;
    Vec3 outward(0);
    outward[face.axis] = face.is_upper ? 1.0 : -1.0;
    matter.Ground().updBody().addContactSurface(Transform(Rotation(SimTK::UnitVec3(outward), SimTK::XAxis), at),
                                                SimTK::ContactSurface(SimTK::ContactGeometry::HalfSpace(), surface));
  }

  void add(const SimbodyBody& b, const SimTK::ContactMaterial& material, bool turns) {
    const SimTK::ContactSurface surface(geometry(b), material);
    auto& ground = matter.Ground();
    if (b.is_static) {
      ground.updBody().addContactSurface(Transform(simbody(b.start.q), simbody(b.start.x)), surface);
      bodies.push_back(ground);
      return;
    }
    SimTK::Body::Rigid body(
        SimTK::MassProperties(b.mass_kg, Vec3(0), turns ? inertia(b.inertia) : SimTK::Inertia(1.0)));
    body.addContactSurface(Transform(simbody(b.shape_at)), surface);
    if (turns)
      bodies.push_back(SimTK::MobilizedBody::Free(ground, Transform(), body, Transform()));
    else
      bodies.push_back(
          SimTK::MobilizedBody::Translation(ground, Transform(), body, Transform(simbody(b.start.q).transpose())));
  }
};

SimbodySystem::SimbodySystem(const SimbodySetup& setup) : world_(std::make_unique<World>()) {
  World& w = *world_;
  w.contact.setTransitionVelocity(setup.slip_speed_m_s);
  const SimTK::Force::UniformGravity gravity(w.forces, w.matter, simbody(setup.gravity_m_s2));
  for (const SimbodySetup::Face& face : setup.faces) w.add(face, material(setup.stiffness_pa, setup.face_surface));
  for (const SimbodyBody& b : setup.bodies) w.add(b, material(setup.stiffness_pa, b.surface), setup.turns);
  for (std::size_t i = 0; i < setup.bodies.size(); ++i)
    if (!setup.bodies[i].is_static && has_wrench(setup.bodies[i]))
      SimTK::Force::Custom(w.forces, new Wrench(w.bodies[i], setup.bodies[i]));  // Simbody owns it

  SimTK::State state = w.system.realizeTopology();
  for (std::size_t i = 0; i < setup.bodies.size(); ++i) {
    const SimbodyPose& s = setup.bodies[i].start;
    if (setup.bodies[i].is_static) continue;
    w.bodies[i].setQToFitTransform(state, Transform(simbody(s.q), simbody(s.x)));
    w.bodies[i].setUToFitVelocity(state, SimTK::SpatialVec(simbody(s.w), simbody(s.v)));
  }
  w.integrator = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(w.system);
  w.integrator->setAccuracy(setup.accuracy);
  w.integrator->setAllowInterpolation(false);
  w.stepper = std::make_unique<SimTK::TimeStepper>(w.system, *w.integrator);
  w.stepper->initialize(state);
}

SimbodySystem::~SimbodySystem() = default;

void SimbodySystem::advance_to(double time_s) {
  world_->stepper->stepTo(time_s);
  world_->system.realize(world_->stepper->getState(), SimTK::Stage::Velocity);
}

SimbodyPose SimbodySystem::pose(std::size_t body) const {
  const SimTK::State& state = world_->stepper->getState();
  const Transform& at = world_->bodies[body].getBodyTransform(state);
  const SimTK::SpatialVec& speed = world_->bodies[body].getBodyVelocity(state);
  const SimTK::Quaternion q = at.R().convertRotationToQuaternion();
  return {vec(at.p()), {q[0], q[1], q[2], q[3]}, vec(speed[1]), vec(speed[0])};
}

std::string simbody_version() {
  int major = 0;
  int minor = 0;
  int patch = 0;
  SimTK_version_simbody(&major, &minor, &patch);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

const void* address_in_simbody() {
  return reinterpret_cast<const void*>(&SimTK_version_simbody);
}

}  // namespace broadside::reference
