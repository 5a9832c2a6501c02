// Which bodies have been touched so far, in one trace or another of the same scene.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::bench {

// What a trace says touches a body: its contacts; without them its points that have an impulse or no gap; without them
// a candidate pair; without them a body that may have met another or the domain, by the boxes that they swept.
class Touches {
 public:
  explicit Touches(std::size_t body_count) : is_touched_(body_count), was_touched_before_(body_count) {}

  // Ahead of the first note of a step.
  void begin_step() { was_touched_before_ = is_touched_; }
  // What a trace with these groups says. Of no contacts and points, motion tells, which may be null.
  void note(const core::FrameRecord& frame, std::uint32_t groups, const validation::Motion* motion);
  void touch(std::uint32_t body, std::uint64_t step);

  [[nodiscard]] bool is_touched(std::uint32_t body) const { return is_touched_[body] != 0; }
  [[nodiscard]] bool was_touched_before(std::uint32_t body) const { return was_touched_before_[body] != 0; }
  [[nodiscard]] std::uint64_t count() const { return count_; }       // bodies
  [[nodiscard]] std::uint64_t first_step() const { return first_; }  // 0 = none

  // The groups that note() reads of a trace that has these.
  static std::uint32_t groups_read(std::uint32_t groups);

 private:
  std::vector<std::uint8_t> is_touched_;
  std::vector<std::uint8_t> was_touched_before_;
  std::uint64_t count_ = 0;
  std::uint64_t first_ = 0;
};

}  // namespace broadside::bench
