#include "reference/simbody_world/simbody_world.hpp"

#include <string>
#include <vector>

#include "reference/loaded_library.hpp"
#include "reference/rigid_world/solid.hpp"
#include "reference/rigid_world/world_record.hpp"
#include "reference/simbody_world/simbody_system.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;

// Simbody's surfaces have a dissipation instead of a restitution. It is chosen to give the scene's restitution at this
// speed of impact.
constexpr double kReferenceSpeed_m_s = 1.0;

SimbodySurface surface_of(const core::Material& m) {
  return {(1.0 - static_cast<double>(m.restitution)) / kReferenceSpeed_m_s, m.mu_static, m.mu_kinetic};
}

core::Result<SimbodyBody> body_of(const RigidStart& start, const core::Scene& scene) {
  const Solid solid = solid_of(scene.meshes[start.mesh]);
  const bool is_box = solid.kind == SolidKind::kBox;
  // In Simbody, bricks have contacts with half-spaces alone.
  const bool is_known = solid.kind == SolidKind::kSphere || (is_box && scene.bodies.size() == 1);
  if (!is_known)
    return core::Error{"unsupported: " + (is_box ? std::string("a box among other bodies") : solid.what), scene.name,
                       "simbody-world has spheres, and a box alone in its domain", core::Exit::kMissing};
  SimbodyBody b;
  b.is_static = start.is_static;
  b.mass_kg = start.mass_kg;
  b.inertia = start.inertia;
  b.start = {start.state.x, start.state.q, start.state.v, start.state.w};
  b.shape_at = -1.0 * start.center_of_mass;
  b.radius_m = solid.radius_m;
  b.half_extents = {solid.half_extents.x, solid.half_extents.y, solid.half_extents.z};
  b.surface = surface_of(start.material);
  b.force_world = start.wrench.force_world;
  b.force_body = start.wrench.force_body;
  b.torque_world = start.wrench.torque_world;
  b.torque_body = start.wrench.torque_body;
  return b;
}

class SimbodyWorld final : public core::Dynamics {
 public:
  explicit SimbodyWorld(const SimbodyOptions& options) : options_(options) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("simbody-world: load", [&]() -> Status {
      time_s_ = 0.0;
      system_.reset();
      if (Status s = record_.load(scene); !s) return s;
      const core::Vec3 g = scene.gravity_m_s2;
      SimbodySetup setup;
      setup.gravity_m_s2 = {g.x, g.y, g.z};
      setup.accuracy = options_.accuracy;
      setup.stiffness_pa = options_.stiffness_pa;
      setup.slip_speed_m_s = options_.slip_speed_m_s;
      setup.turns = record_.turns();
      for (const RigidStart& start : record_.bodies()) {
        auto body = body_of(start, scene);
        if (!body) return body.error();
        setup.bodies.push_back(body.value());
      }
      for (int axis = 0; axis < 3; ++axis) {
        setup.faces.push_back({axis, false, scene.domain.min[axis]});
        setup.faces.push_back({axis, true, scene.domain.max[axis]});
      }
      setup.face_surface = surface_of(scene.face_material);
      system_ = std::make_unique<SimbodySystem>(setup);
      return core::Done{};
    });
  }

  Status step(float dt_s) override {
    return vendor_call("simbody-world: step", [&]() -> Status {
      record_.begin_step();
      time_s_ += dt_s;  // exact: multiples of a float fit into a double
      system_->advance_to(time_s_);
      for (std::size_t i = 0; i < record_.bodies().size(); ++i) {
        if (record_.bodies()[i].is_static) continue;
        const SimbodyPose p = system_->pose(i);
        record_.states()[i] = {p.x, p.q, p.v, p.w};
      }
      return core::Done{};
    });
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return record_.read_back(frame, level);
  }

  [[nodiscard]] std::uint32_t groups() const override {
    return bit(core::Group::kBodies) | bit(core::Group::kWideBodies);
  }

 private:
  SimbodyOptions options_;
  double time_s_ = 0.0;
  WorldRecord record_;
  std::unique_ptr<SimbodySystem> system_;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_simbody_world(const SimbodyOptions& options) {
  return std::make_unique<SimbodyWorld>(options);
}

std::string simbody_build() {
  return "Simbody " + simbody_version() + " (" + loaded_library(address_in_simbody()) + "), double";
}

core::EquivalenceCard simbody_card() {
  return library_card(simbody_build(), address_in_simbody(), "float64", "as its build has it", 1);
}

}  // namespace broadside::reference
