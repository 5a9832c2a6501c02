#include "reference/mujoco_world/mujoco_world.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/contact.hpp"
#include "reference/loaded_library.hpp"
#include "reference/mujoco_world/mujoco_model.hpp"
#include "reference/rigid_world/world_record.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;
using plain::Vec;

// The first warning of MuJoCo since this was cleared. As shipped it writes warnings to a file in the working folder,
// drops contacts that find no room, and restarts the scene from its first state where an acceleration became too large.
thread_local std::string warning;

void hear_warning(const char* text) {
  if (warning.empty()) warning = text;
}

// As shipped, MuJoCo would end the program on an error.
[[noreturn]] void hear_error(const char* text) {
  throw std::runtime_error(text);
}

Vec vec(const mjtNum* v) {
  return {v[0], v[1], v[2]};
}

struct DeleteModel {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
};
struct DeleteData {
  void operator()(mjData* d) const { mj_deleteData(d); }
};

Status no_warning(const char* where) {
  if (warning.empty()) return core::Done{};
  return core::Error{"MuJoCo warned: " + std::exchange(warning, {}), where,
                     "what follows would not be this scene: take a smaller step, or fewer bodies",
                     core::Exit::kMissing};
}

// MuJoCo reads MJCF from files of a virtual file system of its own; here it holds one file in memory.
core::Result<mjModel*> compiled(const std::string& text) {
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kName = "scene.xml";
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(text.size()));
  // NOLINTNEXTLINE(bugprone-not-null-terminated-result): the file has a length
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kName)], text.data(), text.size());
  char error[512] = "";
  mjModel* model = mj_loadXML(kName, files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  mj_freeLastXML();
  if (model != nullptr) return model;
  return core::Error{std::string("MuJoCo does not take the scene: ") + error, "mujoco-world: load",
                     "see reference/README.md for what it supports", core::Exit::kMissing};
}

class MujocoWorld final : public core::Dynamics {
 public:
  MujocoWorld(const MujocoOptions& options, SharedDefectCounter boxes) : options_(options), boxes_(std::move(boxes)) {}

  Status load(const core::Scene& scene) override {
    return vendor_call("mujoco-world: load", [&]() -> Status {
      mju_user_error = hear_error;
      mju_user_warning = hear_warning;
      warning.clear();
      if (Status s = record_.load(scene); !s) return s;
      auto model = compiled(mujoco_model(scene, record_.bodies(), options_));
      if (!model) return model.error();
      data_.reset();
      model_.reset(model.value());
      data_.reset(mj_makeData(model_.get()));
      begin();
      return no_warning("mujoco-world: load");
    });
  }

  Status step(float dt_s) override {
    return vendor_call("mujoco-world: step", [&]() -> Status {
      record_.begin_step();
      model_->opt.timestep = dt_s;
      apply_wrenches();
      mj_step(model_.get(), data_.get());
      if (Status s = no_warning("mujoco-world: step"); !s) return s;
      read_states();
      if (has_points()) read_points(dt_s);
      return core::Done{};
    });
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    return record_.read_back(frame, level);
  }

  [[nodiscard]] std::uint32_t groups() const override {
    const std::uint32_t states = bit(core::Group::kBodies) | bit(core::Group::kWideBodies);
    return has_points() ? states | bit(core::Group::kPoints) : states;
  }

 private:
  [[nodiscard]] bool has_points() const { return options_.integrator != MujocoIntegrator::kRungeKutta; }

  // Body 0 is the world, so the scene's body i is body i + 1 of the model. A body's coordinates begin at those of its
  // joint.
  [[nodiscard]] int first_joint(std::size_t body) const { return model_->body_jntadr[body + 1]; }

  void begin() {
    for (std::size_t i = 0; i < record_.bodies().size(); ++i) {
      if (record_.bodies()[i].is_static) continue;
      const RigidState& s = record_.states()[i];
      mjtNum* speed = data_->qvel + model_->jnt_dofadr[first_joint(i)];
      speed[0] = s.v.x, speed[1] = s.v.y, speed[2] = s.v.z;
      if (!record_.turns()) continue;
      const Vec w = plain::transposed(plain::matrix(s.q)) * s.w;  // a free joint's angular velocity is in body axes
      speed[3] = w.x, speed[4] = w.y, speed[5] = w.z;
    }
  }

  // xfrc_applied acts at the center of mass, in the axes of the world.
  void apply_wrenches() {
    for (std::size_t i = 0; i < record_.bodies().size(); ++i) {
      const BodyWrench& w = record_.bodies()[i].wrench;
      if (w.is_none()) continue;
      const Vec force = w.force(record_.states()[i].q);
      const Vec torque = w.torque(record_.states()[i].q);
      mjtNum* applied = data_->xfrc_applied + 6 * (i + 1);
      applied[0] = force.x, applied[1] = force.y, applied[2] = force.z;
      applied[3] = torque.x, applied[4] = torque.y, applied[5] = torque.z;
    }
  }

  void read_states() {
    for (std::size_t i = 0; i < record_.bodies().size(); ++i) {
      const RigidStart& start = record_.bodies()[i];
      if (start.is_static) continue;
      RigidState& s = record_.states()[i];
      const int joint = first_joint(i);
      const mjtNum* place = data_->qpos + model_->jnt_qposadr[joint];
      const mjtNum* speed = data_->qvel + model_->jnt_dofadr[joint];
      s.v = vec(speed);
      if (!record_.turns()) {
        s.x = start.state.x + vec(place);
        continue;
      }
      s.x = vec(place);
      s.q = {place[3], place[4], place[5], place[6]};
      s.w = plain::matrix(s.q) * vec(speed + 3);
    }
  }

  // Geoms 0 to 5 are the faces, then there is one for each body (mujoco_model). MuJoCo sorts geoms by body, and keeps
  // this order.
  [[nodiscard]] std::uint32_t id_of(int geom) const {
    const int body = model_->geom_bodyid[geom];
    return body == 0 ? core::kFirstFace + static_cast<std::uint32_t>(geom) : static_cast<std::uint32_t>(body - 1);
  }

  // MuJoCo's normal, the first row of a contact's frame, points from geom 1 to geom 2, and its force acts on geom 2.
  // Euler and implicit steps hold that force for the whole step.
  void read_points(double h) {
    for (int k = 0; k < data_->ncon; ++k) {
      const mjContact& contact = data_->contact[k];
      note_depth(contact);
      if (contact.exclude != 0 || contact.efc_address < 0) continue;
      mjtNum force[6];
      mj_contactForce(model_.get(), data_.get(), k, force);
      const Vec on_second =
          force[0] * vec(contact.frame) + force[1] * vec(contact.frame + 3) + force[2] * vec(contact.frame + 6);
      record_.add_point(id_of(contact.geom1), id_of(contact.geom2), vec(contact.pos), -vec(contact.frame), contact.dist,
                        -h * on_second);
    }
  }

  // Half of a box's extent along a unit vector.
  [[nodiscard]] double half_extent(int geom, Vec n) const {
    const mjtNum* r = data_->geom_xmat + std::ptrdiff_t{9} * geom;  // rows; columns are the box's axes
    const mjtNum* half = model_->geom_size + std::ptrdiff_t{3} * geom;
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += half[k] * std::abs(r[k] * n.x + r[3 + k] * n.y + r[6 + k] * n.z);
    return sum;
  }

  // No point of two boxes can be deeper along a normal than the boxes overlap along it. Geoms are at the poses of the
  // step's start.
  void note_depth(const mjContact& contact) {
    const int a = contact.geom1;
    const int b = contact.geom2;
    if (model_->geom_type[a] != mjGEOM_BOX || model_->geom_type[b] != mjGEOM_BOX) return;
    const Vec n = vec(contact.frame);
    const Vec between = vec(data_->geom_xpos + std::ptrdiff_t{3} * b) - vec(data_->geom_xpos + std::ptrdiff_t{3} * a);
    const double sizes = half_extent(a, n) + half_extent(b, n);
    // A few dozen roundings of numbers of the boxes' size.
    const bool is_too_deep =
        -contact.dist > sizes - plain::dot(between, n) + 0x1p-45 * (sizes + plain::length(between));
    boxes_->note(is_too_deep ? 1 : 0, 1);
  }

  MujocoOptions options_;
  SharedDefectCounter boxes_;
  WorldRecord record_;
  std::unique_ptr<mjModel, DeleteModel> model_;
  std::unique_ptr<mjData, DeleteData> data_;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_mujoco_world(const MujocoOptions& options, SharedDefectCounter boxes) {
  return std::make_unique<MujocoWorld>(options, std::move(boxes));
}

std::string mujoco_build() {
  return std::string("MuJoCo ") + mj_versionString() + " (" +
         loaded_library(reinterpret_cast<const void*>(&mj_versionString)) + "), " +
         (sizeof(mjtNum) == sizeof(double) ? "double" : "float");
}

core::EquivalenceCard mujoco_card() {
  return library_card(mujoco_build(), reinterpret_cast<const void*>(&mj_versionString), "float64",
                      "as its build has it", 1);
}

}  // namespace broadside::reference
