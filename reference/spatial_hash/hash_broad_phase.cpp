#include "reference/spatial_hash/hash_broad_phase.hpp"

#include <oneapi/tbb/task_arena.h>

#include <optional>
#include <utility>
#include <vector>

#include "reference/given_boxes.hpp"
#include "reference/spatial_hash/spatial_hash.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;

class HashBroadPhase final : public core::BroadPhase {
 public:
  HashBroadPhase(float cell_m, int threads) : hash_(cell_m) {
    if (threads > 0) arena_.emplace(threads);
  }

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load("hash-cpu", boxes, is_static); !status) return status;
    return build();
  }

  // Enters bodies in cells and sorts.
  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update("hash-cpu", boxes); !status) return status;
    return build();
  }

  Status find() override {
    return vendor_call("hash-cpu: find", [&]() -> Status {
      execute([&] { hash_.find(pairs_); });
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override {
    core::PairSet set;
    set.pairs = pairs_;
    set.demanded = set.raw = pairs_.size();
    return set;
  }

 private:
  Status build() {
    return vendor_call("hash-cpu: build", [&]() -> Status {
      execute([&] { hash_.build(given_.boxes(), given_.is_static()); });
      return core::Done{};
    });
  }

  template <typename Work>
  void execute(Work&& work) {
    if (arena_) {
      arena_->execute(std::forward<Work>(work));
    } else {
      work();
    }
  }

  std::optional<tbb::task_arena> arena_;
  GivenBoxes given_;
  SpatialHash hash_;
  std::vector<core::Pair> pairs_;
};

}  // namespace

std::unique_ptr<core::BroadPhase> make_hash_broad_phase(float cell_m, int threads) {
  return std::make_unique<HashBroadPhase>(cell_m, threads);
}

}  // namespace broadside::reference
