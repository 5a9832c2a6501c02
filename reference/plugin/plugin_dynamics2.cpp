// A simulation by an untrusted plug-in of version 2, or by a program. States are float64; points, contacts, detection
// and pairs are recorded where the engine gives them.
#include "reference/plugin/plugin_dynamics2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/own_step_time.hpp"
#include "core/method/frame_digest.hpp"
#include "core/scene/refuse_springs.hpp"
#include "core/scene/refuse_turning.hpp"
#include "reference/given_boxes.hpp"
#include "reference/plugin/plugin_array.hpp"
#include "reference/plugin/plugin_records.hpp"
#include "reference/plugin/plugin_scene2.hpp"

namespace broadside::reference {
namespace {

using core::Group;
using core::Status;

class PluginDynamics2 final : public core::Dynamics, public core::OwnStepTime {
 public:
  PluginDynamics2(std::shared_ptr<PluginInstance> instance, bool turns)
      : instance_(std::move(instance)), turns_(turns) {}

  ~PluginDynamics2() override { end(); }

  Status load(const core::Scene& scene) override {
    if (Status s = core::refuse_springs(scene); !s) return s;
    if (Status s = turns_ ? Status(core::Done{}) : core::refuse_turning(scene); !s) return s;
    end();
    source_ = &scene;
    steps_ = 0;
    is_static_.clear();
    for (const core::Body& body : scene.bodies) is_static_.push_back(body.inverse_mass > 0.0F ? 0 : 1);
    auto made = PluginScene2::of(scene);
    if (!made) return made.error();
    scene_ = std::move(made).value();
    return instance_->checked(table().begin(instance_->self(), scene_->c_struct()), "begin");
  }

  Status step(float dt_s) override {
    ++steps_;
    return instance_->checked(table().step(instance_->self(), dt_s), "step");
  }

  [[nodiscard]] double last_step_s() const override { return instance_->source().last_step_s(instance_->self()); }

  [[nodiscard]] std::uint32_t groups() const override {
    std::uint32_t groups = bit(Group::kBodies) | bit(Group::kWideBodies);
    if (table().read_points != nullptr) groups |= bit(Group::kPoints);
    if (table().read_contacts != nullptr) groups |= bit(Group::kContacts);
    if (table().read_detection != nullptr) groups |= bit(Group::kDetection) | bit(Group::kDetectedOrientation);
    if (table().read_step_pairs != nullptr) groups |= bit(Group::kPairs);
    return groups;
  }

  Status read_back(core::FrameRecord& frame, core::RecordLevel level) override {
    frame = {};
    frame.step = steps_;
    frame.time_s = static_cast<double>(steps_) * static_cast<double>(source_->dt_s);
    const std::array<Status (PluginDynamics2::*)(core::FrameRecord&), 5> parts{
        &PluginDynamics2::read_states, &PluginDynamics2::read_points, &PluginDynamics2::read_contacts,
        &PluginDynamics2::read_detection, &PluginDynamics2::read_step_pairs};
    for (const auto part : parts)
      if (Status status = (this->*part)(frame); !status) return status;
    for (std::uint32_t i = 0; i < frame.position.size(); ++i)
      frame.digest +=
          core::body_digest(i, frame.position[i], frame.orientation[i], frame.velocity[i], frame.angular_velocity[i]);
    for (const core::Contact& c : frame.contacts) frame.digest += core::contact_digest(c);
    if (level == core::RecordLevel::kFull) return core::Done{};
    core::FrameRecord bare;
    bare.step = frame.step;
    bare.time_s = frame.time_s;
    bare.digest = frame.digest;
    frame = std::move(bare);
    return core::Done{};
  }

 private:
  [[nodiscard]] const broadside_engine2& table() const { return instance_->table(); }

  // One row a body. An array that was not written is all bytes 0xFF.
  template <typename Row>
  core::Result<std::vector<Row>> rows_of_bodies(int (*read)(void*, Row*, std::uint32_t), const char* call) {
    const std::uint32_t n = source_->body_count();
    auto got = read_all<Row>(*host_, n, [&](Row* out, std::size_t, std::uint64_t* demanded) {
      *demanded = n;
      return instance_->checked(read(instance_->self(), out, n), call);
    });
    if (!got) return got.error();
    for (std::size_t i = 0; i < got.value().values.size(); ++i)
      if (is_unwritten(got.value().values[i]))
        return fault(call, "it did not write body " + std::to_string(i) + " of " + std::to_string(n));
    return std::move(got).value().values;
  }

  // As many rows as the engine reports; at the second call they must fit the room.
  template <typename Row>
  core::Result<std::vector<Row>> rows_of_step(int (*read)(void*, Row*, std::uint64_t, std::uint64_t*), const char* call,
                                              std::size_t& room_before) {
    auto got = read_all<Row>(*host_, room_before, [&](Row* out, std::size_t room, std::uint64_t* demanded) -> Status {
      Status status = instance_->checked(read(instance_->self(), out, room, demanded), call);
      // More than 4 GiB is treated as a wrong count.
      if (status.ok() && *demanded > (std::uint64_t{1} << 32) / sizeof(Row))
        return fault(call, "it claims to have " + std::to_string(*demanded) + " rows");
      return status;
    });
    if (!got) return got.error();
    std::vector<Row>& rows = got.value().values;
    if (rows.size() != got.value().demanded)
      return fault(call, "it has " + std::to_string(got.value().demanded) + " rows now, but had " +
                             std::to_string(rows.size()) + " a call before");
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (is_unwritten(rows[k]))
        return fault(
            call, "it reports " + std::to_string(rows.size()) + " rows, but did not write number " + std::to_string(k));
    room_before = std::max(room_before, rows.size() * 5 / 4);
    return std::move(rows);
  }

  Status read_states(core::FrameRecord& frame) {
    auto states = rows_of_bodies(table().read_states, "read_states");
    if (!states) return states.error();
    for (const broadside_state2& s : states.value()) add_state(s, frame);
    return core::Done{};
  }

  Status read_points(core::FrameRecord& frame) {
    if (table().read_points == nullptr) return core::Done{};
    auto points = rows_of_step(table().read_points, "read_points", point_room_);
    if (!points) return points.error();
    for (const broadside_point& p : points.value()) {
      if (std::string wrong = fault_of_point(p, source_->body_count()); !wrong.empty())
        return fault("read_points", "point number " + std::to_string(frame.points.size()) + " " + wrong);
      frame.points.push_back(point_from_c(p));
    }
    return core::Done{};
  }

  Status read_contacts(core::FrameRecord& frame) {
    if (table().read_contacts == nullptr) return core::Done{};
    auto contacts = rows_of_step(table().read_contacts, "read_contacts", contact_room_);
    if (!contacts) return contacts.error();
    for (const broadside_contact& c : contacts.value()) {
      if (std::string wrong = fault_of_bodies(c.a, c.b, source_->body_count()); !wrong.empty())
        return fault("read_contacts", "contact number " + std::to_string(frame.contacts.size()) + " " + wrong);
      frame.contacts.push_back(contact_from_c(c));
    }
    return core::Done{};
  }

  Status read_detection(core::FrameRecord& frame) {
    if (table().read_detection == nullptr) return core::Done{};
    auto seen = rows_of_bodies(table().read_detection, "read_detection");
    if (!seen) return seen.error();
    for (const broadside_detection& d : seen.value()) add_detection(d, frame);
    return core::Done{};
  }

  // A pair that cannot exist is an error; one that can exist but is wrong is left to the validators.
  Status read_step_pairs(core::FrameRecord& frame) {
    if (table().read_step_pairs == nullptr) return core::Done{};
    auto pairs = rows_of_step(table().read_step_pairs, "read_step_pairs", pair_room_);
    if (!pairs) return pairs.error();
    for (const broadside_pair& p : pairs.value()) {
      if (p.i >= p.j || p.j >= source_->body_count())
        return fault("read_step_pairs", "pair number " + std::to_string(frame.pairs.size()) + " is (" +
                                            std::to_string(p.i) + ", " + std::to_string(p.j) +
                                            "), and a pair has i < j < " + std::to_string(source_->body_count()));
      frame.pairs.push_back({p.i, p.j});
    }
    frame.pairs_raw = frame.pairs_demanded = frame.pairs.size();
    if (table().is_exact != 0) {
      std::sort(frame.pairs.begin(), frame.pairs.end());
      return core::Done{};
    }
    GivenBoxes given;
    if (Status s = given.load(table().id, frame.boxes, is_static_); !s) return s;
    frame.pairs = given.tighten(std::move(frame.pairs)).pairs;
    frame.pairs_demanded = frame.pairs.size();
    return core::Done{};
  }

  [[nodiscard]] core::Error fault(const char* call, std::string what) const {
    return {std::move(what), instance_->where(call), "", core::Exit::kMissing};
  }

  void end() {
    if (scene_ && table().end != nullptr) table().end(instance_->self());
    scene_.reset();
  }

  std::shared_ptr<PluginInstance> instance_;
  bool turns_;
  std::unique_ptr<core::MemorySpace> host_ = core::make_host_space();
  const core::Scene* source_ = nullptr;
  std::unique_ptr<PluginScene2> scene_;
  std::vector<std::uint8_t> is_static_;
  std::uint64_t steps_ = 0;
  std::size_t point_room_ = 256;
  std::size_t contact_room_ = 256;
  std::size_t pair_room_ = 1024;
};

}  // namespace

std::unique_ptr<core::Dynamics> make_plugin_dynamics2(std::shared_ptr<PluginInstance> instance) {
  const auto declaration = instance->source().declaration("");
  const bool turns = declaration.ok() && declaration.value().turns();
  return std::make_unique<PluginDynamics2>(std::move(instance), turns);
}

}  // namespace broadside::reference
