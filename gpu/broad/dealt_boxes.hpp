// A set of boxes dealt to parts of space, on the host: each to the part in which it begins, and numbered part by part.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/space_parts.hpp"
#include "core/math/box.hpp"
#include "core/method/box_passes.hpp"
#include "core/result.hpp"
#include "gpu/broad/broad_buffers.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// The search of bulk pairs keeps a mark of one bit beside a box's number, and its table has 2^31 buckets: numbers of
// more boxes do not fit.
constexpr std::uint64_t kMostBoxes = 1ULL << 30U;
// An error, with exit code 3, if there are more; it says how many boxes there are.
core::Status check_box_limit(std::uint64_t boxes);

class DealtBoxes {
 public:
  // An error names the first one that is not a box, by the caller's number.
  core::Status take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                    const core::SpaceCut& cut);
  // Takes the boxes of a pass, in its coordinates; the cut must be in these coordinates too. The boxes must be sound.
  void take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::SpaceCut& cut,
            const core::PassPlan& plan, const core::BoxPass& pass);
  // The fit for all boxes of a set: fitted_cells.hpp.
  [[nodiscard]] BulkFit fitted(std::span<const core::Box> boxes) const;
  void set_fit(const BulkFit& fit) {
    for (BoxFacts& facts : facts_) facts.fit = fit;
  }

  [[nodiscard]] std::uint32_t parts() const { return static_cast<std::uint32_t>(facts_.size()); }
  [[nodiscard]] std::span<const PackedBox> boxes(std::uint32_t part) const {
    return std::span(packed_).subspan(base_[part], base_[part + 1] - base_[part]);
  }
  // If this is a pass: these boxes as SettleView has them; else none.
  [[nodiscard]] std::span<const PackedBox> given_boxes(std::uint32_t part) const {
    if (given_boxes_.empty()) return {};
    return std::span(given_boxes_).subspan(base_[part], base_[part + 1] - base_[part]);
  }
  // The number of the part's first box.
  [[nodiscard]] std::uint32_t base(std::uint32_t part) const { return base_[part]; }
  // Facts of the boxes that begin in the part, except sizes, which are those of all boxes, because any box may reach
  // into it.
  [[nodiscard]] const BoxFacts& facts(std::uint32_t part) const { return facts_[part]; }
  // The caller's number of a box.
  [[nodiscard]] std::uint32_t given(std::uint32_t number) const { return given_[number]; }

 private:
  template <typename BoxAt>
  void deal(std::size_t count, const core::SpaceCut& cut, const BoxAt& box_at);

  std::vector<PackedBox> packed_;
  std::vector<PackedBox> given_boxes_;
  std::vector<std::uint32_t> base_;
  std::vector<std::uint32_t> given_;
  std::vector<BoxFacts> facts_;
};

}  // namespace broadside::gpu
