// Pairs from an untrusted plug-in: each is checked.
#include "reference/plugin/plugin_broad_phase.hpp"

#include <algorithm>
#include <utility>

#include "reference/given_boxes.hpp"
#include "reference/plugin/plugin_array.hpp"

namespace broadside::reference {
namespace {

using core::Status;

static_assert(sizeof(core::Box) == sizeof(broadside_box) && sizeof(core::Pair) == sizeof(broadside_pair));

// Absurd counts are refused before memory is allocated: no set of n boxes has more pairs.
std::uint64_t most_pairs(std::uint64_t n) {
  return n < 2 ? 0 : n * (n - 1) / 2;
}

class PluginBroadPhase final : public core::BroadPhase {
 public:
  PluginBroadPhase(std::shared_ptr<PluginInstance> instance, std::shared_ptr<core::MemorySpace> space)
      : instance_(std::move(instance)), space_(std::move(space)), boxes_(*space_), is_static_(*space_) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = table().is_exact != 0, .margin_m = table().margin_m, .keeps_stale_pairs = false};
  }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(table().id, boxes, is_static); !status) return status;
    auto held = boxes_.hold(boxes);
    if (!held) return held.error();
    auto flags = is_static_.hold(is_static);
    if (!flags) return flags.error();
    return instance_->checked(table().load_boxes(instance_->self(), as_c(held.value()), flags.value(), given_.count()),
                              "load_boxes");
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(table().id, boxes); !status) return status;
    auto held = boxes_.hold(boxes);
    if (!held) return held.error();
    return instance_->checked(table().update_boxes(instance_->self(), as_c(held.value()), given_.count()),
                              "update_boxes");
  }

  Status find() override { return instance_->checked(table().find_pairs(instance_->self()), "find_pairs"); }

  core::Result<core::PairSet> read_back() override {
    const std::uint64_t most = most_pairs(given_.count());
    auto read = read_all<core::Pair>(
        *space_, std::min<std::uint64_t>(most, room_), [&](core::Pair* out, std::size_t room, std::uint64_t* demanded) {
          Status status = instance_->checked(
              table().read_pairs(instance_->self(), reinterpret_cast<broadside_pair*>(out), room, demanded),
              "read_pairs");
          if (status.ok() && *demanded > 2 * most + 16)
            return Status(fault("it claims to have " + std::to_string(*demanded) + " pairs of " +
                                std::to_string(given_.count()) + " boxes"));
          return status;
        });
    if (!read) return read.error();
    room_ = std::max<std::uint64_t>(room_, read.value().demanded + read.value().demanded / 4);
    return checked_set(std::move(read).value());
  }

 private:
  [[nodiscard]] const broadside_engine2& table() const { return instance_->table(); }
  static const broadside_box* as_c(const core::Box* boxes) { return reinterpret_cast<const broadside_box*>(boxes); }

  [[nodiscard]] core::Error fault(std::string what) const {
    return {std::move(what), instance_->where("read_pairs"), "", core::Exit::kMissing};
  }

  // A pair that cannot exist is a plug-in error; a pair that can exist but is wrong is left to the validators.
  core::Result<core::PairSet> checked_set(Read<core::Pair> read) {
    for (std::size_t k = 0; k < read.values.size(); ++k) {
      const core::Pair p = read.values[k];
      if (p.i == ~0U && p.j == ~0U)
        return fault("it reports " + std::to_string(read.demanded) + " pairs, but did not write number " +
                     std::to_string(k));
      if (p.i >= p.j || p.j >= given_.count())
        return fault("pair number " + std::to_string(k) + " is (" + std::to_string(p.i) + ", " + std::to_string(p.j) +
                     "), and a pair has i < j < " + std::to_string(given_.count()));
    }
    if (table().is_exact == 0) {
      const std::uint64_t missing = read.demanded - read.values.size();
      core::PairSet set = given_.tighten(std::move(read.values));
      set.demanded += missing;
      return set;
    }
    core::PairSet set;
    set.raw = read.demanded;
    set.demanded = read.demanded;
    set.pairs = std::move(read.values);
    std::sort(set.pairs.begin(), set.pairs.end());
    return set;
  }

  std::shared_ptr<PluginInstance> instance_;
  std::shared_ptr<core::MemorySpace> space_;
  GivenBoxes given_;
  PluginInput<core::Box> boxes_;
  PluginInput<std::uint8_t> is_static_;
  std::uint64_t room_ = 1024;
};

}  // namespace

std::unique_ptr<core::BroadPhase> make_plugin_broad_phase(std::shared_ptr<PluginInstance> instance,
                                                          std::shared_ptr<core::MemorySpace> space) {
  return std::make_unique<PluginBroadPhase>(std::move(instance), std::move(space));
}

}  // namespace broadside::reference
