// Which bodies have been touched so far, in one trace or another of the same scene.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::bench {

// Which bodies a trace shows to be touched: those with a contact; without contacts, those with a point that has an
// impulse or no gap; without points too, those in a candidate pair, and those whose swept boxes may have met another
// body or the domain.
class Touches {
 public:
  explicit Touches(std::size_t body_count) : is_touched_(body_count), was_touched_before_(body_count) {}

  // Call it before the first note of a step.
  void begin_step() { was_touched_before_ = is_touched_; }
  // Notes the touches that a frame of a trace with these groups shows. Where the trace has neither contacts nor points,
  // motion is used, which may be null.
  void note(const core::FrameRecord& frame, std::uint32_t groups, const validation::Motion* motion);
  void touch(std::uint32_t body, std::uint64_t step);

  [[nodiscard]] bool is_touched(std::uint32_t body) const { return is_touched_[body] != 0; }
  [[nodiscard]] bool was_touched_before(std::uint32_t body) const { return was_touched_before_[body] != 0; }
  [[nodiscard]] std::uint64_t count() const { return count_; }       // bodies
  [[nodiscard]] std::uint64_t first_step() const { return first_; }  // 0 = none

  // The one of a trace's groups that note() reads.
  static std::uint32_t groups_read(std::uint32_t groups);

 private:
  std::vector<std::uint8_t> is_touched_;
  std::vector<std::uint8_t> was_touched_before_;
  std::uint64_t count_ = 0;
  std::uint64_t first_ = 0;
};

}  // namespace broadside::bench
