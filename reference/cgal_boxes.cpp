// CGAL's box_self_intersection_d: a streamed segment tree (Zomorodian and Edelsbrunner) that hands ranges below its
// cutoff to a scan. Another family of algorithm than every tree and grid here, which makes it a good second opinion.
#if BROADSIDE_HAS_CGAL
#include <CGAL/box_intersection_d.h>
#include <CGAL/version.h>
#endif

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "reference/engines.hpp"
#include "reference/given_boxes.hpp"
#include "reference/vendor_build.hpp"
#include "reference/vendor_call.hpp"

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "cgal-boxes";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"cutoff", "100", {}, "ranges of no more boxes than this are scanned rather than divided"},
  }};
  return kSettings;
}

#if BROADSIDE_HAS_CGAL
using core::Status;
using NumberedBox =
    CGAL::Box_intersection_d::Box_with_info_d<float, 3, std::uint32_t, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

class CgalBoxes final : public core::BroadPhase {
 public:
  explicit CgalBoxes(unsigned long cutoff) : cutoff_(static_cast<std::ptrdiff_t>(cutoff)) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override {
    return {.exact = true, .margin_m = 0.0, .keeps_stale_pairs = false};
  }

  Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    if (Status status = given_.load(kId, boxes, is_static); !status) return status;
    return number_boxes();
  }

  Status update(std::span<const core::Box> boxes) override {
    if (Status status = given_.update(kId, boxes); !status) return status;
    return number_boxes();
  }

  // The algorithm sorts what it is given, here pointers. It keeps nothing from one call to the next.
  Status find() override {
    return vendor_call("cgal-boxes: find", [&]() -> Status {
      pairs_.clear();
      pointers_.clear();
      for (const NumberedBox& box : boxes_) pointers_.push_back(&box);
      CGAL::box_self_intersection_d(
          pointers_.begin(), pointers_.end(),
          [this](const NumberedBox* a, const NumberedBox* b) {
            pairs_.push_back(core::make_pair_of(a->info(), b->info()));
          },
          cutoff_, CGAL::Box_intersection_d::CLOSED);
      return core::Done{};
    });
  }

  core::Result<core::PairSet> read_back() override { return given_.tighten(pairs_); }

 private:
  Status number_boxes() {
    return vendor_call("cgal-boxes: update", [&]() -> Status {
      boxes_.clear();
      pairs_.clear();
      for (std::uint32_t i = 0; i < given_.count(); ++i) {
        const core::Box& box = given_.boxes()[i];
        std::array<float, 3> low{box.min.x, box.min.y, box.min.z};
        std::array<float, 3> high{box.max.x, box.max.y, box.max.z};
        boxes_.emplace_back(low.data(), high.data(), i);
      }
      return core::Done{};
    });
  }

  std::ptrdiff_t cutoff_;
  GivenBoxes given_;
  std::vector<NumberedBox> boxes_;
  std::vector<const NumberedBox*> pointers_;
  std::vector<core::Pair> pairs_;
};

core::Result<core::Engine> create(const core::Settings& settings) {
  core::Engine engine;
  engine.id = kId;
  engine.build = "CGAL " CGAL_VERSION_STR ", float";
  engine.settings = settings;
  engine.equivalence = [build = engine.build, cutoff = settings.text("cutoff")](const core::Scene&) {
    core::EquivalenceCard card = own_card(build + ", headers alone", "float32", "as the compiler made it", 1);
    card.push_back({"broad-phase margin", "none", ""});
    card.push_back({"topology", "closed intervals", ""});
    card.push_back({"cutoff", cutoff + " boxes are scanned rather than divided", ""});
    return card;
  };
  engine.broad_phase = std::make_unique<CgalBoxes>(settings.number("cutoff"));
  return engine;
}

std::string absent() {
  return {};
}
#else
core::Result<core::Engine> create(const core::Settings&) {
  return core::Error{"built without CGAL", std::string(kId), "configure with -DBROADSIDE_CGAL=ON",
                     core::Exit::kMissing};
}

std::string absent() {
  return "built without CGAL";
}
#endif

}  // namespace

core::EngineRow cgal_boxes_row() {
  return {.id = kId,
          .capabilities = "broad",
          .what = "CGAL's streamed segment tree for boxes (box_self_intersection_d)",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = absent};
}

}  // namespace broadside::reference
