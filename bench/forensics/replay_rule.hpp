// How far a replay may be from what was recorded: nothing where bits are promised, derived limits elsewhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/forensics/trace_difference.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

// Pairs of an engine that was fed the recorded boxes: equal as sets. Where the recorder does not promise exact pairs
// (margins, stale pairs), pairs that only it has are counted and pass.
class PairRule final : public DifferenceRule {
 public:
  explicit PairRule(bool is_exact) : is_exact_(is_exact) {}
  [[nodiscard]] std::uint32_t groups() const override { return core::bit(core::Group::kPairs); }
  [[nodiscard]] bool includes_bookkeeping() const override { return false; }
  bool passes(const core::FrameDifference& difference) override;
  [[nodiscard]] std::uint64_t extra() const { return extra_; }

 private:
  bool is_exact_;
  std::uint64_t extra_ = 0;
};

// Separations at the recorded poses. Distances of surfaces that are apart agree within the rounding of world
// coordinates to float32, sqrt(3) u (W_A + W_B) in each of the two engines, W = the largest coordinate of a body's
// vertices. Inside that band of 0 the flag may be either. Depths, normals and witness points of overlapping or parallel
// surfaces are conventions, and are not compared.
class SeparationRule final : public DifferenceRule {
 public:
  explicit SeparationRule(const core::Scene& scene);
  [[nodiscard]] std::uint32_t groups() const override {
    return core::bit(core::Group::kNarrow) | core::bit(core::Group::kDetection);
  }
  [[nodiscard]] bool includes_bookkeeping() const override { return false; }
  void enter(const core::FrameRecord& a, const core::FrameRecord& b) override;
  bool passes(const core::FrameDifference& difference) override;
  [[nodiscard]] std::uint64_t judged() const { return judged_; }

 private:
  std::vector<double> reach_m_;  // largest coordinate of each body's mesh
  const core::FrameRecord* a_ = nullptr;
  const core::FrameRecord* b_ = nullptr;
  std::uint64_t judged_ = 0;
};

// A simulation from the recorded start. Two engines that integrate by P(1) to P(3) part by rounding alone until a body
// is first touched: dt g (one product in ours; at most five operations where a recorder goes by forces: mass, m g, 1 /
// m, two products), one addition for each velocity, a product and an addition for each position, and what the
// velocity's error moves. After a body's first contact in either trace no bound is derived and nothing is judged:
// contacts double a difference at every bounce. Where the recording has no contacts, a candidate pair counts as one.
//
// Ends of steps are always compared. Detection states are compared where both engines look at the same moment: the
// pipeline's engines look after they moved the bodies; an engine whose detection states equal the states at the
// beginning of the step looked before, as Bullet does. Boxes are compared where the recorder adds no margin to them.
class FlightRule final : public DifferenceRule {
 public:
  // Both outlive the rule; replayed has every step.
  FlightRule(const core::TraceReader& recorded, const core::TraceReader& replayed);
  [[nodiscard]] std::uint32_t groups() const override {
    return core::bit(core::Group::kBodies) | (is_one_moment() ? core::bit(core::Group::kDetection) : 0U);
  }
  [[nodiscard]] bool includes_bookkeeping() const override { return false; }
  // Whether the recorder looked for contacts before it moved the bodies, and whether both engines agree in that.
  [[nodiscard]] bool detects_first() const { return detects_first_; }
  [[nodiscard]] bool is_one_moment() const { return is_one_moment_; }
  [[nodiscard]] bool has_margin() const { return has_margin_; }
  void enter(const core::FrameRecord& a, const core::FrameRecord& b) override;
  bool passes(const core::FrameDifference& difference) override;

  [[nodiscard]] std::uint64_t judged() const { return judged_; }            // bodies times steps
  [[nodiscard]] std::uint64_t touched() const { return touched_count_; }    // bodies that were touched
  [[nodiscard]] std::uint64_t first_touch() const { return first_touch_; }  // step; 0 = none
  [[nodiscard]] const std::string& error() const { return error_; }         // of reading; empty = none

 private:
  void advance(const core::FrameRecord& ours);
  void touch(std::uint32_t body, std::uint64_t step);
  void note_contacts(const core::FrameRecord& frame, bool has_contacts);

  const core::TraceReader& recorded_;
  const core::TraceReader& replayed_;
  const core::Scene& scene_;
  bool detects_first_ = false;
  bool is_one_moment_ = true;
  bool has_margin_ = false;
  std::uint64_t next_ = 0;  // frame of the replayed trace
  // Bounds on the difference of the two engines, per body: largest component.
  std::vector<double> velocity_bound_m_s_;
  std::vector<double> position_bound_m_;
  std::vector<std::uint8_t> is_touched_;          // at the end of the step
  std::vector<std::uint8_t> was_touched_before_;  // when detection looked
  std::uint64_t judged_ = 0;
  std::uint64_t touched_count_ = 0;
  std::uint64_t first_touch_ = 0;
  std::string error_;
};

}  // namespace broadside::bench
