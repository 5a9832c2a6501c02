// Separations from an untrusted plug-in.
#include "reference/plugin/plugin_narrow_phase.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "reference/pair_check.hpp"
#include "reference/plugin/plugin_array.hpp"
#include "reference/plugin/plugin_scene.hpp"
#include "reference/plugin/plugin_scene2.hpp"

namespace broadside::reference {
namespace {

using core::Status;

static_assert(sizeof(core::Pose) == sizeof(broadside_pose) && sizeof(core::Pair) == sizeof(broadside_pair));

class PluginNarrowPhase final : public core::NarrowPhase {
 public:
  PluginNarrowPhase(std::shared_ptr<PluginInstance> instance, std::shared_ptr<core::MemorySpace> space)
      : instance_(std::move(instance)), space_(std::move(space)), pairs_(*space_), poses_(*space_) {}

  ~PluginNarrowPhase() override { end(); }

  Status load(const core::Scene& scene) override {
    end();
    body_count_ = scene.body_count();
    pair_count_ = 0;
    if (const broadside_engine* first = instance_->source().version1()) {
      scene_.emplace(scene);
      return instance_->checked(first->load_scene(instance_->self(), scene_->c_struct()), "load_scene");
    }
    auto made = PluginScene2::of(scene);
    if (!made) return made.error();
    scene2_ = std::move(made).value();
    return instance_->checked(table().load_scene(instance_->self(), scene2_->c_struct()), "load_scene");
  }

  Status measure(std::span<const core::Pair> pairs, std::span<const core::Pose> poses) override {
    if (Status status = check_pairs(table().id, pairs, poses, body_count_); !status) return status;
    auto held_pairs = pairs_.hold(pairs);
    if (!held_pairs) return held_pairs.error();
    auto held_poses = poses_.hold(poses);
    if (!held_poses) return held_poses.error();
    pair_count_ = pairs.size();
    return instance_->checked(
        table().measure(instance_->self(), reinterpret_cast<const broadside_pair*>(held_pairs.value()), pair_count_,
                        reinterpret_cast<const broadside_pose*>(held_poses.value()), body_count_),
        "measure");
  }

  core::Result<std::vector<core::Separation>> read_back() override {
    auto read = read_all<broadside_separation>(
        *space_, pair_count_, [&](broadside_separation* out, std::size_t room, std::uint64_t* demanded) -> Status {
          Status status =
              instance_->checked(table().read_separations(instance_->self(), out, room, demanded), "read_separations");
          if (status.ok() && *demanded != pair_count_)
            return core::Error{
                "it has " + std::to_string(*demanded) + " separations for " + std::to_string(pair_count_) + " pairs",
                instance_->where("read_separations"), "", core::Exit::kMissing};
          return status;
        });
    if (!read) return read.error();
    std::vector<core::Separation> separations;
    separations.reserve(pair_count_);
    for (const broadside_separation& s : read.value().values) {
      if (s.is_touching > 1)
        return core::Error{"is_touching of separation " + std::to_string(separations.size()) + " is neither 0 nor 1",
                           instance_->where("read_separations"), "write every field of every separation",
                           core::Exit::kMissing};
      separations.push_back({.distance_m = s.distance_m,
                             .is_touching = s.is_touching == 1,
                             .normal = vec3_from_c(s.normal),
                             .witness_a = vec3_from_c(s.witness_a),
                             .witness_b = vec3_from_c(s.witness_b)});
    }
    return separations;
  }

 private:
  [[nodiscard]] const broadside_engine2& table() const { return instance_->table(); }

  void end() {
    if ((scene_ || scene2_) && table().end != nullptr) table().end(instance_->self());
    scene_.reset();
    scene2_.reset();
  }

  std::shared_ptr<PluginInstance> instance_;
  std::shared_ptr<core::MemorySpace> space_;
  std::optional<PluginScene> scene_;
  std::unique_ptr<PluginScene2> scene2_;
  PluginInput<core::Pair> pairs_;
  PluginInput<core::Pose> poses_;
  std::uint32_t body_count_ = 0;
  std::size_t pair_count_ = 0;
};

}  // namespace

std::unique_ptr<core::NarrowPhase> make_plugin_narrow_phase(std::shared_ptr<PluginInstance> instance,
                                                            std::shared_ptr<core::MemorySpace> space) {
  return std::make_unique<PluginNarrowPhase>(std::move(instance), std::move(space));
}

}  // namespace broadside::reference
