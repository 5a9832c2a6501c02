// How far a replay may differ from the recording: not at all where bits are promised, else by derived limits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/forensics/trace_difference.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

// Pairs of an engine that was given the recorded boxes: they must be equal as sets. Where the recorder does not promise
// exact pairs (margins, stale pairs), pairs that only the recording has are counted and pass.
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

}  // namespace broadside::bench
