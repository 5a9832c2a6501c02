// FCL's broad-phase managers on the given boxes: one adapter, because they share an interface.
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

using core::Status;

using Object = fcl::CollisionObject<double>;
using Manager = fcl::BroadPhaseCollisionManager<double>;

fcl::AABB<double> fcl_box(const core::Box& b) {
  fcl::AABB<double> box;
  box.min_ = {b.min.x, b.min.y, b.min.z};
  box.max_ = {b.max.x, b.max.y, b.max.z};
  return box;
}

struct BoxGeometry final : fcl::CollisionGeometry<double> {
  void computeLocalAABB() override {}  // aabb_local is given
};

std::uint32_t body_of(const Object* object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
}

// FCL's callback: appends the pair to the std::vector<core::Pair> behind `pairs` and asks for more.
bool collect(Object* a, Object* b, void* pairs) {
  static_cast<std::vector<core::Pair>*>(pairs)->push_back(core::make_pair_of(body_of(a), body_of(b)));
  return false;
}

// The given boxes as collision objects that consist of a box alone. Float converts to double exactly and the pose stays
// the identity, so FCL's box of an object is the given box: it adds a translation of 0.0.
class BoxObjects {
 public:
  void assign(std::span<const core::Box> boxes) {
    geometries_.clear();
    objects_.clear();
    pointers_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      auto geometry = std::make_shared<BoxGeometry>();
      geometry->aabb_local = fcl_box(boxes[i]);
      auto object = std::make_unique<Object>(geometry);  // takes its box from the geometry
      object->setUserData(
          reinterpret_cast<void*>(static_cast<std::uintptr_t>(i)));  // NOLINT(performance-no-int-to-ptr)
      pointers_.push_back(object.get());
      geometries_.push_back(std::move(geometry));
      objects_.push_back(std::move(object));
    }
  }

  void update(std::span<const core::Box> boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      geometries_[i]->aabb_local = fcl_box(boxes[i]);
      objects_[i]->computeAABB();
    }
  }

  [[nodiscard]] const std::vector<Object*>& pointers() const { return pointers_; }

 private:
  std::vector<std::shared_ptr<BoxGeometry>> geometries_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<Object*> pointers_;
};

// A manager for these boxes. Only the spatial hash uses the boxes: its grid spans the boxes that were loaded (others go
// to a list that it searches linearly), with cells as large as the mean longest side.
std::unique_ptr<Manager> make_manager(std::string_view name, std::span<const core::Box> boxes) {
  if (name == "tree") return std::make_unique<fcl::DynamicAABBTreeCollisionManager<double>>();
  if (name == "tree-array") return std::make_unique<fcl::DynamicAABBTreeCollisionManager_Array<double>>();
  if (name == "sap") return std::make_unique<fcl::SaPCollisionManager<double>>();
  if (name == "ssap") return std::make_unique<fcl::SSaPCollisionManager<double>>();
  if (name == "interval-tree") return std::make_unique<fcl::IntervalTreeCollisionManager<double>>();
  fcl::AABB<double> scene;
  double side_sum = 0.0;
  for (const core::Box& b : boxes) {
    const fcl::AABB<double> box = fcl_box(b);
    scene += box;
    side_sum += (box.max_ - box.min_).maxCoeff();
  }
  const double mean_side = boxes.empty() ? 0.0 : side_sum / static_cast<double>(boxes.size());
  const double cell = mean_side > 0.0 ? mean_side : 1.0;  // points only: any cell will do
  if (boxes.empty()) scene = fcl::AABB<double>(fcl::Vector3<double>::Zero());
  return std::make_unique<fcl::SpatialHashingCollisionManager<double>>(cell, scene.min_, scene.max_);
}

class FclBroadPhase final : public core::BroadPhase {
 public:
  FclBroadPhase(std::string_view id, std::string_view manager) : id_(id), manager_name_(manager) {}

  // The boxes inside are exactly the given ones (see BoxObjects): nothing is fattened, and no pairs are kept between
  // frames. Three managers lose boxes that only touch (README, known defects), so they are not called exact.
  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = manager_name_ == "tree" || manager_name_ == "tree-array" || manager_name_ == "ssap"};
  }

  // The incremental manager finds the pairs of its objects as they enter, and that work is timed. So objects enter in
  // the first update or find. The other managers only sort and build here.
  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(id_, boxes, is_static); !status) return status;
    return vendor_call(id_ + ": load", [&]() -> Status {
      manager_ = make_manager(manager_name_, given_.boxes());
      objects_.assign(given_.boxes());
      raw_.clear();
      has_entered_ = false;
      if (manager_name_ != "sap") enter();
      return core::Done{};
    });
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(id_, boxes); !status) return status;
    return vendor_call(id_ + ": update", [&]() -> Status {
      objects_.update(boxes);
      if (!enter() && !boxes.empty()) manager_->update();
      return core::Done{};
    });
  }

  Status find() override {
    raw_.clear();
    if (given_.count() < 2) return core::Done{};
    return vendor_call(id_ + ": find", [&]() -> Status {
      enter();
      manager_->collide(&raw_, collect);
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override { return given_.tighten(raw_); }

 private:
  // False when the objects are in already.
  bool enter() {
    if (has_entered_) return false;
    has_entered_ = true;
    manager_->registerObjects(objects_.pointers());
    manager_->setup();
    return true;
  }

  std::string id_;
  std::string manager_name_;
  GivenBoxes given_;
  BoxObjects objects_;
  std::unique_ptr<Manager> manager_;
  bool has_entered_ = false;
  std::vector<core::Pair> raw_;
};

core::Result<core::Engine> make_engine(std::string_view id, const core::Settings& settings) {
  core::Engine engine;
  engine.id = id;
  engine.build = fcl_build();
  engine.settings = settings;
  engine.broad_phase = std::make_unique<FclBroadPhase>(id, settings.text("manager"));
  engine.equivalence = [](const core::Scene&) {
    core::EquivalenceCard card = fcl_card(1);
    card.push_back({"broad-phase margin", "none", ""});
    return card;
  };
  return engine;
}

std::span<const core::SettingRow> tree_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"manager", "tree", {"tree", "tree-array"}, "nodes linked by pointers, or by indices into one array"},
  }};
  return kSettings;
}

std::span<const core::SettingRow> sap_settings() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"manager",
       "ssap",
       {"ssap", "sap", "interval-tree", "spatial-hash"},
       "simple sweep and prune (sorts each frame); incremental (known to crash); interval trees; a hash grid"},
  }};
  return kSettings;
}

}  // namespace

core::EngineRow fcl_tree_row() {
  return {.id = "fcl-tree",
          .capabilities = "broad",
          .what = "FCL's dynamic AABB tree on the same boxes",
          .settings = tree_settings(),
          .runs_in_child = true,
          .create = [](const core::Settings& s) { return make_engine("fcl-tree", s); },
          .absent = [] { return std::string(); }};
}

core::EngineRow fcl_sap_row() {
  return {.id = "fcl-sap",
          .capabilities = "broad",
          .what = "FCL's sweep and prune, and its other broad-phase managers, on the same boxes",
          .settings = sap_settings(),
          .runs_in_child = true,
          .create = [](const core::Settings& s) { return make_engine("fcl-sap", s); },
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference
