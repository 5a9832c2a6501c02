// A simulation that another engine repeats: both must agree on each body until it is first touched.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/forensics/flight_bounds.hpp"
#include "bench/forensics/touches.hpp"
#include "bench/forensics/trace_difference.hpp"
#include "core/trace/trace_reader.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::bench {

// States at the ends of steps are always compared, within FlightBounds. After a body's first touch in either trace
// nothing of it is judged and no bound is derived: engines answer contacts by different models, and every bounce
// doubles a difference. The orientation of a body is compared until its bound is half a turn.
//
// Detection states are compared where both engines look for contacts at the same moment. Boxes are compared where no
// engine adds a margin to them and bodies do not turn, because the box of a turned body may be loose (box-contains
// judges each box alone).
class FlightRule final : public DifferenceRule {
 public:
  // Both readers must outlive the rule; `replayed` must have every step.
  FlightRule(const core::TraceReader& recorded, const core::TraceReader& replayed);
  [[nodiscard]] std::uint32_t groups() const override;
  [[nodiscard]] bool includes_bookkeeping() const override { return false; }
  // Whether the recorder looked for contacts before it moved the bodies, and whether both engines agree in that.
  [[nodiscard]] bool detects_first() const { return recorded_moment_ == "start"; }
  [[nodiscard]] bool replay_detects_first() const { return replayed_moment_ == "start"; }
  [[nodiscard]] bool is_one_moment() const { return recorded_moment_ == replayed_moment_; }
  [[nodiscard]] bool has_margin() const { return has_margin_; }
  [[nodiscard]] bool is_turning() const { return is_turning_; }
  void enter(const core::FrameRecord& a, const core::FrameRecord& b) override;
  bool passes(const core::FrameDifference& difference) override;

  [[nodiscard]] std::uint64_t judged() const { return judged_; }  // bodies times steps
  [[nodiscard]] const Touches& touches() const { return touches_; }
  // Bodies whose orientation left the comparison because its bound reached half a turn, and the first such step.
  [[nodiscard]] std::uint64_t outgrown() const { return outgrown_count_; }
  [[nodiscard]] std::uint64_t first_outgrown() const { return first_outgrown_; }
  [[nodiscard]] const std::string& error() const { return error_; }  // of reading a trace; empty = none

 private:
  core::Status advance_to(const core::FrameRecord& recorded);
  void advance(const validation::Motion& motion);
  void note_clipped(const validation::Motion& motion);
  [[nodiscard]] double narrowed(double value) const;
  [[nodiscard]] bool orientations_agree(std::uint32_t body) const;

  const core::TraceReader& recorded_;
  const core::TraceReader& replayed_;
  const core::Scene& scene_;
  bool are_wide_;    // both record states in float64
  bool is_turning_;  // bodies of the scene turn
  bool has_margin_;  // boxes cannot be compared
  bool one_clips_;   // one engine clips velocities, as METHOD does, and the other does not
  std::string_view recorded_moment_;
  std::string_view replayed_moment_;
  FlightBounds bounds_;
  Touches touches_;
  validation::MotionReader motions_;
  std::optional<core::FrameRecord> ours_before_;
  std::uint64_t next_ = 0;  // frame of the replayed trace
  std::vector<std::uint8_t> has_outgrown_;
  const core::FrameRecord* a_ = nullptr;
  const core::FrameRecord* b_ = nullptr;
  std::uint64_t judged_ = 0;
  std::uint64_t outgrown_count_ = 0;
  std::uint64_t first_outgrown_ = 0;
  std::string error_;
};

}  // namespace broadside::bench
