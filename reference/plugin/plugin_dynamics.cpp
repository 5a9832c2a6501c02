// A simulation by a plug-in of version 1 of the interface. Records states, and contacts where the plug-in gives them.
#include "reference/plugin/plugin_dynamics.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/method/frame_digest.hpp"
#include "core/scene/refuse_springs.hpp"
#include "core/scene/refuse_wrenches.hpp"
#include "reference/plugin/plugin_array.hpp"
#include "reference/plugin/plugin_records.hpp"
#include "reference/plugin/plugin_scene.hpp"

namespace broadside::reference {
namespace {

using core::Status;

class PluginDynamics final : public core::Dynamics {
 public:
  PluginDynamics(std::shared_ptr<PluginInstance> instance, std::shared_ptr<core::MemorySpace> space)
      : instance_(std::move(instance)), space_(std::move(space)) {}

  ~PluginDynamics() override { end(); }

  Status load(const core::Scene& scene) override {
    if (Status s = core::refuse_springs(scene); !s) return s;
    if (scene.motion == core::Motion::kRigid)
      return core::Error{"the scene's bodies turn, and version 1 of the interface gives no inertia",
                         instance_->where("begin"), "export broadside_engine_v2", core::Exit::kMissing};
    if (Status s = core::refuse_wrenches(scene); !s) return s;
    end();
    source_ = &scene;
    steps_ = 0;
    scene_.emplace(scene);
    return instance_->checked(table().begin(instance_->self(), scene_->c_struct()), "begin");
  }

  Status step(float dt_s) override {
    ++steps_;
    return instance_->checked(table().step(instance_->self(), dt_s), "step");
  }

  [[nodiscard]] std::uint32_t groups() const override {
    return core::bit(core::Group::kBodies) |
           (table().read_contacts != nullptr ? core::bit(core::Group::kContacts) : 0U);
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    frame = {};
    frame.step = steps_;
    frame.time_s = static_cast<double>(steps_) * static_cast<double>(source_->dt_s);
    if (Status status = read_states(frame); !status) return status;
    if (Status status = read_contacts(frame); !status) return status;
    for (std::uint32_t i = 0; i < frame.position.size(); ++i)
      frame.digest +=
          core::body_digest(i, frame.position[i], frame.orientation[i], frame.velocity[i], frame.angular_velocity[i]);
    for (const core::Contact& c : frame.contacts) frame.digest += core::contact_digest(c);
    if (level != core::RecordLevel::kFull) {
      core::FrameRecord bare;
      bare.step = frame.step;
      bare.time_s = frame.time_s;
      bare.digest = frame.digest;
      frame = std::move(bare);
    }
    return core::Done{};
  }

 private:
  [[nodiscard]] const broadside_engine& table() const { return *instance_->source().version1(); }

  Status read_states(core::FrameRecord& frame) {
    const std::uint32_t n = source_->body_count();
    auto read = read_all<broadside_state>(*space_, n, [&](broadside_state* out, std::size_t, std::uint64_t* demanded) {
      *demanded = n;
      return instance_->checked(table().read_states(instance_->self(), out, n), "read_states");
    });
    if (!read) return read.error();
    for (const broadside_state& s : read.value().values) {
      frame.position.push_back(vec3_from_c(s.position));
      frame.orientation.push_back(quat_from_c(s.orientation));
      frame.velocity.push_back(vec3_from_c(s.velocity));
      frame.angular_velocity.push_back(vec3_from_c(s.angular_velocity));
    }
    return core::Done{};
  }

  Status read_contacts(core::FrameRecord& frame) {
    if (table().read_contacts == nullptr) return core::Done{};
    // Contacts are host arrays even when the states are on the device.
    auto read = read_all<broadside_contact>(
        *host_, contact_room_, [&](broadside_contact* out, std::size_t room, std::uint64_t* demanded) -> Status {
          Status status =
              instance_->checked(table().read_contacts(instance_->self(), out, room, demanded), "read_contacts");
          // More than 4 GiB of contacts is treated as a wrong count.
          if (status.ok() && *demanded > (std::uint64_t{1} << 32) / sizeof(broadside_contact))
            return fault("it claims to have " + std::to_string(*demanded) + " contacts");
          return status;
        });
    if (!read) return read.error();
    if (read.value().values.size() != read.value().demanded)
      return fault("it has " + std::to_string(read.value().demanded) + " contacts now, but had " +
                   std::to_string(read.value().values.size()) + " a call before");
    contact_room_ = std::max<std::size_t>(contact_room_, read.value().values.size() * 5 / 4);
    for (const broadside_contact& c : read.value().values) {
      if (c.a >= source_->body_count() || (c.b >= source_->body_count() && !core::is_face(c.b)))
        return fault("contact number " + std::to_string(frame.contacts.size()) + " is between " + std::to_string(c.a) +
                     " and " + std::to_string(c.b) + ", and there are " + std::to_string(source_->body_count()) +
                     " bodies");
      frame.contacts.push_back(contact_from_c(c));
    }
    return core::Done{};
  }

  [[nodiscard]] core::Error fault(std::string what) const {
    return {std::move(what), instance_->where("read_contacts"), "", core::Exit::kMissing};
  }

  void end() {
    if (scene_ && table().end != nullptr) table().end(instance_->self());
    scene_.reset();
  }

  std::shared_ptr<PluginInstance> instance_;
  std::shared_ptr<core::MemorySpace> space_;
  std::unique_ptr<core::MemorySpace> host_ = core::make_host_space();
  const core::Scene* source_ = nullptr;
  std::optional<PluginScene> scene_;
  std::uint64_t steps_ = 0;
  std::size_t contact_room_ = 256;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_plugin_dynamics(std::shared_ptr<PluginInstance> instance,
                                                     std::shared_ptr<core::MemorySpace> space) {
  return std::make_unique<PluginDynamics>(std::move(instance), std::move(space));
}

}  // namespace broadside::reference
