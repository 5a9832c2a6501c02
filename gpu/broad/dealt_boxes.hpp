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

// More boxes have numbers that the search of bulk pairs cannot hold beside a mark of one bit, in a table of 2^31
// buckets.
constexpr std::uint64_t kMostBoxes = 1ULL << 30U;
// Exit code 3, with how many there are.
core::Status check_box_limit(std::uint64_t boxes);

class DealtBoxes {
 public:
  // An error names the first that is no box, by the caller's number.
  core::Status take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static,
                    const core::SpaceCut& cut);
  // Those of a pass, in its coordinates, which the cut is in too. They are sound.
  void take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::SpaceCut& cut,
            const core::PassPlan& plan, const core::BoxPass& pass);
  // What fits all boxes of a set: fitted_cells.hpp.
  [[nodiscard]] BulkFit fitted(std::span<const core::Box> boxes) const;
  void set_fit(const BulkFit& fit) {
    for (BoxFacts& facts : facts_) facts.fit = fit;
  }

  [[nodiscard]] std::uint32_t parts() const { return static_cast<std::uint32_t>(facts_.size()); }
  [[nodiscard]] std::span<const PackedBox> boxes(std::uint32_t part) const {
    return std::span(packed_).subspan(base_[part], base_[part + 1] - base_[part]);
  }
  // Of a pass, these boxes as SettleView has them; else none.
  [[nodiscard]] std::span<const PackedBox> given_boxes(std::uint32_t part) const {
    if (given_boxes_.empty()) return {};
    return std::span(given_boxes_).subspan(base_[part], base_[part + 1] - base_[part]);
  }
  // The number of the part's first box.
  [[nodiscard]] std::uint32_t base(std::uint32_t part) const { return base_[part]; }
  // Of the boxes that begin in the part, but for the sizes, which are those of all boxes: any may reach into it.
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
