// Bullet's two-tree dynamic bounding volume hierarchy, fed the given boxes through setAabb. Its pair cache is a
// superset: leaves are fattened by gDbvtMargin when they move, and collide() re-checks a tenth of the cached pairs a
// call, so pairs stay after their boxes have parted. read_back filters on the given boxes.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <array>
#include <memory>
#include <utility>

#include "reference/bullet_margin.hpp"
#include "reference/bullet_proxy.hpp"
#include "reference/bullet_vectors.hpp"
#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"
#include "reference/vendor_defects.hpp"

namespace broadside::reference {
namespace {

using core::Pair;
using core::Status;

constexpr std::string_view kBulletDbvtId = "bullet-dbvt";

// setAabb reads the global gDbvtMargin: this sets it for the length of one call and then restores it.
class MarginScope {
 public:
  explicit MarginScope(btScalar margin) : before_(gDbvtMargin) { gDbvtMargin = margin; }
  ~MarginScope() { gDbvtMargin = before_; }
  MarginScope(const MarginScope&) = delete;
  MarginScope& operator=(const MarginScope&) = delete;

 private:
  btScalar before_;
};

class BulletDbvt final : public core::BroadPhase {
 public:
  BulletDbvt(btScalar margin, bool is_deferred, SharedDefectCounter stale)
      : margin_(margin), is_deferred_(is_deferred), stale_(std::move(stale)) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = true, .margin_m = static_cast<double>(margin_), .keeps_stale_pairs = true};
  }

  // Bullet finds the pairs of a box as the box enters, and that work is timed. So boxes enter in the first update or
  // find, and are only stored here.
  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kBulletDbvtId, boxes, is_static); !status) return status;
    return vendor_call("bullet-dbvt: load", [&]() -> Status {
      destroy_proxies();
      // Without a pair cache of ours, the broad phase makes and owns its hashed one.
      broad_phase_ = std::make_unique<btDbvtBroadphase>();
      broad_phase_->m_deferedcollide = is_deferred_;
      return core::Done{};
    });
  }

  // Unless deferred, Bullet finds new pairs in here: count the times of update and find together.
  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kBulletDbvtId, boxes); !status) return status;
    return vendor_call("bullet-dbvt: update", [&]() -> Status {
      if (enter()) return core::Done{};
      const MarginScope scope(margin_);
      for (std::size_t i = 0; i < proxies_.size(); ++i)
        broad_phase_->setAabb(proxies_[i], bullet(boxes[i].min), bullet(boxes[i].max), nullptr);
      return core::Done{};
    });
  }

  Status find() override {
    if (broad_phase_ == nullptr) return core::Done{};
    return vendor_call("bullet-dbvt: find", [&]() -> Status {
      enter();
      broad_phase_->calculateOverlappingPairs(nullptr);
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override {
    if (broad_phase_ == nullptr) return core::PairSet{};
    return vendor_call("bullet-dbvt: read_back", [&]() -> core::Result<core::PairSet> {
      const btBroadphasePairArray& cache = broad_phase_->getOverlappingPairCache()->getOverlappingPairArray();
      std::vector<Pair> raw;
      raw.reserve(static_cast<std::size_t>(cache.size()));
      for (int k = 0; k < cache.size(); ++k)
        raw.push_back(core::make_pair_of(body_of(cache[k].m_pProxy0->m_clientObject),
                                         body_of(cache[k].m_pProxy1->m_clientObject)));
      core::PairSet set = given_.tighten(std::move(raw));
      stale_->note(set.raw - set.pairs.size(), set.raw);
      return set;
    });
  }

  ~BulletDbvt() override { destroy_proxies(); }

 private:
  // False when the boxes are in already.
  bool enter() {
    if (!proxies_.empty()) return false;
    const std::span<const core::Box> boxes = given_.boxes();
    const std::span<const std::uint8_t> is_static = given_.is_static();
    proxies_.reserve(boxes.size());
    for (std::uint32_t i = 0; i < given_.count(); ++i) {
      // As btCollisionWorld does it: two static bodies make no pair; all other pairs pass the filter.
      const int group = is_static[i] != 0 ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
      const int mask = is_static[i] != 0 ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter
                                         : static_cast<int>(btBroadphaseProxy::AllFilter);
      void* body = reinterpret_cast<void*>(static_cast<std::uintptr_t>(i));  // NOLINT(performance-no-int-to-ptr)
      proxies_.push_back(broad_phase_->createProxy(bullet(boxes[i].min), bullet(boxes[i].max), BOX_SHAPE_PROXYTYPE,
                                                   body, group, mask, nullptr));
    }
    return true;
  }

  // Bullet leaves proxies to their creator. Its destroyProxy looks through all pairs for each proxy, minutes for
  // 100,000 boxes. Here all of them go at once, so it is enough to give the memory back, which createProxy allocated.
  void destroy_proxies() {
    broad_phase_.reset();
    for (btBroadphaseProxy* proxy : proxies_) btAlignedFree(proxy);
    proxies_.clear();
  }

  btScalar margin_;
  bool is_deferred_;
  SharedDefectCounter stale_;
  GivenBoxes given_;
  std::unique_ptr<btDbvtBroadphase> broad_phase_;
  std::vector<btBroadphaseProxy*> proxies_;
};

std::span<const core::SettingRow> bullet_dbvt_settings() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"margin",
       "bullet",
       {"bullet", core::kMeters},
       "by how much a moving leaf is fattened: what Bullet ships (0.05 m in 3.24), or meters; 0 = not at all"},
      {"deferred", "off", {"off", "on"}, "on: pairs are found by one tree-tree pass in find instead of inside setAabb"},
  }};
  return kSettings;
}

core::Result<core::Engine> create_bullet_dbvt(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kBulletDbvtId;
  engine.build = bullet_build();
  engine.settings = settings;
  // Every function that changes gDbvtMargin restores it, so this is the value with which the library was shipped: 0.05
  // m in 3.24.
  const btScalar margin = margin_m_of(settings, gDbvtMargin);
  const auto stale = std::make_shared<DefectCounter>(Defect::kBulletStalePairs);
  engine.broad_phase = std::make_unique<BulletDbvt>(margin, settings.text("deferred") == "on", stale);
  engine.equivalence = [margin](const core::Scene&) {
    core::EquivalenceCard card = bullet_card();
    card.push_back(bullet_margin_fact(margin));
    card.push_back({"pair cache", "a tenth of it is re-checked a frame; filtered in a zone of its own", "exact pairs"});
    return card;
  };
  engine.defects = defects_of(stale);
  return engine;
}

}  // namespace

core::EngineRow bullet_dbvt_row() {
  return {.id = kBulletDbvtId,
          .capabilities = "broad",
          .what = "Bullet's btDbvtBroadphase on the same boxes",
          .settings = bullet_dbvt_settings(),
          .runs_in_child = true,
          .create = create_bullet_dbvt,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
