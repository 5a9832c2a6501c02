// Bullet's incremental sweep and prune with 32-bit end points.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "reference/bullet_proxy.hpp"
#include "reference/bullet_vectors.hpp"
#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;

constexpr std::string_view kBulletSapId = "bullet-sap";

// End points are quantized within a world that is fixed when it is made, and clamped to it. The world is the bounds of
// the loaded boxes with their own size added on every side, at least 1 m, because a world without extent divides by
// zero.
core::Box sweep_world(std::span<const core::Box> boxes) {
  core::Box all{{0, 0, 0}, {0, 0, 0}};
  if (!boxes.empty()) {
    all = core::empty_box();
    for (const core::Box& b : boxes) all = core::grown(core::grown(all, b.min), b.max);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float size = std::max(1.0F, all.max[axis] - all.min[axis]);
    all.min[axis] -= size;
    all.max[axis] += size;
  }
  return all;
}

class BulletSap final : public core::BroadPhase {
 public:
  ~BulletSap() override { destroy_proxies(); }

  // One step of the quantization is the world's extent over 2^31, finer than the float spacing of the boxes. Rounding
  // and clamping are monotone, so no pair is lost, and some are added.
  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }

  // Bullet finds the pairs of a box as the box enters, and that work is timed. So boxes enter in the first update or
  // find, and are only stored here.
  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kBulletSapId, boxes, is_static); !status) return status;
    return vendor_call("bullet-sap: load", [&]() -> Status {
      destroy_proxies();
      const core::Box world = sweep_world(boxes);
      // No rays are cast here, and the tree for rays would be updated in the timed zone.
      sweep_ = std::make_unique<bt32BitAxisSweep3>(bullet(world.min), bullet(world.max), given_.count() + 1, nullptr,
                                                   /*disableRaycastAccelerator=*/true);
      return core::Done{};
    });
  }

  // Pairs come and go in here, as end points pass each other: count the times of update and find together.
  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kBulletSapId, boxes); !status) return status;
    return vendor_call("bullet-sap: update", [&]() -> Status {
      if (enter()) return core::Done{};
      for (std::size_t i = 0; i < proxies_.size(); ++i)
        sweep_->setAabb(proxies_[i], bullet(boxes[i].min), bullet(boxes[i].max), nullptr);
      return core::Done{};
    });
  }

  Status find() override {
    if (sweep_ == nullptr) return core::Done{};
    return vendor_call("bullet-sap: find", [&]() -> Status {
      enter();
      sweep_->calculateOverlappingPairs(nullptr);
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override {
    if (sweep_ == nullptr) return core::PairSet{};
    return vendor_call("bullet-sap: read_back", [&]() -> core::Result<core::PairSet> {
      const btBroadphasePairArray& cache = sweep_->getOverlappingPairCache()->getOverlappingPairArray();
      std::vector<core::Pair> raw;
      raw.reserve(static_cast<std::size_t>(cache.size()));
      for (int k = 0; k < cache.size(); ++k)
        raw.push_back(core::make_pair_of(body_of(cache[k].m_pProxy0->m_clientObject),
                                         body_of(cache[k].m_pProxy1->m_clientObject)));
      return given_.tighten(std::move(raw));
    });
  }

 private:
  // False when the boxes are in already.
  bool enter() {
    if (!proxies_.empty()) return false;
    const std::span<const core::Box> boxes = given_.boxes();
    const std::span<const std::uint8_t> is_static = given_.is_static();
    proxies_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < given_.count(); ++i) {
      const int group = is_static[i] != 0 ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
      const int mask = is_static[i] != 0 ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter
                                         : static_cast<int>(btBroadphaseProxy::AllFilter);
      void* body = reinterpret_cast<void*>(static_cast<std::uintptr_t>(i));  // NOLINT(performance-no-int-to-ptr)
      proxies_.push_back(sweep_->createProxy(bullet(boxes[i].min), bullet(boxes[i].max), BOX_SHAPE_PROXYTYPE, body,
                                             group, mask, nullptr));
    }
    return true;
  }

  void destroy_proxies() {
    if (sweep_ == nullptr) return;
    for (btBroadphaseProxy* proxy : proxies_) sweep_->destroyProxy(proxy, nullptr);
    proxies_.clear();
  }

  GivenBoxes given_;
  std::unique_ptr<bt32BitAxisSweep3> sweep_;
  std::vector<btBroadphaseProxy*> proxies_;
};

core::Result<core::Engine> create_bullet_sap(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kBulletSapId;
  engine.build = bullet_build();
  engine.settings = settings;
  engine.broad_phase = std::make_unique<BulletSap>();
  engine.equivalence = [](const core::Scene&) {
    core::EquivalenceCard card = bullet_card();
    card.push_back({"broad-phase margin", "quantized outward to float's spacing", "none"});
    return card;
  };
  return engine;
}

}  // namespace

core::EngineRow bullet_sap_row() {
  return {.id = kBulletSapId,
          .capabilities = "broad",
          .what = "Bullet's incremental sweep and prune (bt32BitAxisSweep3) on the same boxes",
          .settings = {},
          .runs_in_child = true,
          .create = create_bullet_sap,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
