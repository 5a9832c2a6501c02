// `broad=kept`: KeptPairs behind core's interface.
#include <memory>
#include <string>
#include <vector>

#include "core/engine/search_path.hpp"
#include "reference/scene_octree/box_check.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "reference/scene_octree/kept_pairs.hpp"
#include "reference/scene_octree/own_arena.hpp"

namespace broadside::reference {
namespace {

class KeptBroadPhase final : public core::BroadPhase, public core::TellsPath {
 public:
  explicit KeptBroadPhase(int threads) : arena_(threads) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }

  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    count_ = is_static.size();
    kept_.start(is_static);
    return update(boxes);
  }

  core::Status update(std::span<const core::Box> boxes) override {
    if (core::Status s = check_box_count(boxes.size(), count_); !s) return s;
    bool is_sound = true;
    arena_.execute([&] { is_sound = kept_.build(boxes); });
    if (!is_sound) return unsound_box(boxes);
    return core::Done{};
  }

  core::Status find() override {
    arena_.execute([&] { kept_.find(); });
    return core::Done{};
  }

  core::Result<core::PairSet> read_back() override {
    core::PairSet set;
    arena_.execute([&] { kept_.read_back(set.pairs); });
    set.demanded = set.raw = set.pairs.size();
    return set;
  }

  [[nodiscard]] std::vector<core::Counter> counters() const override {
    return {{"broad: nodes visited", kept_.tree().nodes_visited()},
            {"broad: box tests", 8U * kept_.tree().packs_tested()},
            {"broad: candidates tested", kept_.candidates_tested()},
            {"broad: frames searched", kept_.searched_frames()},
            {"broad: frames of kept pairs", kept_.kept_frames()}};
  }

  [[nodiscard]] std::string path() const override {
    return std::to_string(kept_.searched_frames()) + " frames searched, " + std::to_string(kept_.kept_frames()) +
           " from pairs that were kept";
  }

 private:
  OwnArena arena_;
  KeptPairs kept_;
  std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<core::BroadPhase> make_kept_broad_phase(int threads) {
  return std::make_unique<KeptBroadPhase>(threads);
}

}  // namespace broadside::reference
