// Bullet's bounding volume tree without the broad phase around it: no pair cache, no stages, one tree-tree traversal a
// frame. It separates the cost of the tree from that of btDbvtBroadphase's bookkeeping.
#include <BulletCollision/BroadphaseCollision/btDbvt.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <array>
#include <memory>
#include <vector>

#include "reference/bullet_margin.hpp"
#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;

constexpr std::string_view kBulletDbvtTreeId = "bullet-dbvt-tree";

btDbvtVolume volume_of(const core::Box& b) {
  return btDbvtAabbMm::FromMM({b.min.x, b.min.y, b.min.z}, {b.max.x, b.max.y, b.max.z});
}

// What a traversal does with two leaves whose volumes overlap.
struct Collect final : btDbvt::ICollide {
  std::vector<core::Pair> pairs;

  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    pairs.push_back(core::make_pair_of(body_of(a), body_of(b)));
  }
  static std::uint32_t body_of(const btDbvtNode* leaf) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(leaf->data));
  }
};

struct Trees {
  btDbvt moving;
  btDbvt fixed;
};

class BulletDbvtTree final : public core::BroadPhase {
 public:
  explicit BulletDbvtTree(btScalar margin) : margin_(margin) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = true, .margin_m = static_cast<double>(margin_), .keeps_stale_pairs = false};
  }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kBulletDbvtTreeId, boxes, is_static); !status) return status;
    return vendor_call("bullet-dbvt-tree: load", [&]() -> Status {
      trees_ = std::make_unique<Trees>();
      leaves_.clear();
      found_.pairs.clear();
      for (std::uint32_t i = 0; i < given_.count(); ++i) {
        void* number = reinterpret_cast<void*>(static_cast<std::uintptr_t>(i));  // NOLINT(performance-no-int-to-ptr)
        leaves_.push_back(tree_of(i).insert(volume_of(boxes[i]), number));
      }
      trees_->moving.optimizeTopDown();
      trees_->fixed.optimizeTopDown();
      return core::Done{};
    });
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kBulletDbvtTreeId, boxes); !status) return status;
    return vendor_call("bullet-dbvt-tree: update", [&]() -> Status {
      for (std::uint32_t i = 0; i < given_.count(); ++i) {
        btDbvtVolume volume = volume_of(boxes[i]);
        if (margin_ > 0) {
          tree_of(i).update(leaves_[i], volume, margin_);  // nothing when the fat leaf still contains it
        } else {
          tree_of(i).update(leaves_[i], volume);
        }
      }
      // One pass a frame, as btDbvtBroadphase::collide does.
      trees_->moving.optimizeIncremental(1);
      return core::Done{};
    });
  }

  Status find() override {
    found_.pairs.clear();
    if (trees_ == nullptr) return core::Done{};
    return vendor_call("bullet-dbvt-tree: find", [&]() -> Status {
      btDbvt& moving = trees_->moving;
      moving.collideTT(moving.m_root, moving.m_root, found_);
      moving.collideTT(moving.m_root, trees_->fixed.m_root, found_);
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override { return given_.tighten(found_.pairs); }

 private:
  btDbvt& tree_of(std::uint32_t body) { return given_.is_static()[body] != 0 ? trees_->fixed : trees_->moving; }

  btScalar margin_;
  GivenBoxes given_;
  std::unique_ptr<Trees> trees_;
  std::vector<btDbvtNode*> leaves_;
  Collect found_;
};

std::span<const core::SettingRow> bullet_dbvt_tree_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"margin",
       "0",
       {"bullet", core::kMeters},
       "by how much a moving leaf is fattened: meters, or what Bullet ships (0.05 m in 3.24)"},
  }};
  return kSettings;
}

core::Result<core::Engine> create_bullet_dbvt_tree(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kBulletDbvtTreeId;
  engine.build = bullet_build();
  engine.settings = settings;
  const btScalar margin = margin_m_of(settings, gDbvtMargin);
  engine.broad_phase = std::make_unique<BulletDbvtTree>(margin);
  engine.equivalence = [margin](const core::Scene&) {
    core::EquivalenceCard card = bullet_card();
    card.push_back(bullet_margin_fact(margin));
    return card;
  };
  return engine;
}

}  // namespace

core::EngineRow bullet_dbvt_tree_row() {
  return {.id = kBulletDbvtTreeId,
          .capabilities = "broad",
          .what = "Bullet's bounding volume tree alone (btDbvt::collideTT), without its pair cache",
          .settings = bullet_dbvt_tree_settings(),
          .runs_in_child = true,
          .create = create_bullet_dbvt_tree,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
