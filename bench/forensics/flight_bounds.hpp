// How far two right engines may be apart in a body that flies freely: the sum of what each may be off by rounding and
// by truncation, step after step.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/trace_header.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::bench {

// What an engine declares that bounds its free flight.
struct FlightParty {
  explicit FlightParty(const core::TraceHeader& header);

  double roundoff = 0.0;  // of its arithmetic or its record, the coarser
  double substeps = 1.0;
  double order = 1.0;
  double pull_operations = 1;  // rounded operations behind h g
};

// One body's allowance: the largest that a component may differ by.
struct FlightBound {
  double velocity_m_s = 0.0;
  double position_m = 0.0;  // of the center of mass
  double momentum_kg_m2_s = 0.0;
  double spin_rad_s = 0.0;
  double angle_rad = 0.0;
};

// Rounding, in each engine: additions to v and x in each substep, and the operations behind h g.
// Position: a step of order 1 moves a body by h times a velocity between its first and its last, so at most h^2 g / 2
// from the exact parabola, in n substeps 1/n of that; a step of order 2 or more is exact for a constant force. Engines
// that declare one integrator, order and number of substeps truncate alike.
// Turning: the laws gyroscopic and turning allow a step h |w x L| / 2 of the angular momentum and h |dw| + (h |w|)^3 /
// 12 of the angle; each order above the first is another factor h |w|. An error of momentum or angle turns into one of
// spin, and that into one of angle, so that the bound grows until it bounds nothing: neighboring motions of a free body
// part.
class FlightBounds {
 public:
  FlightBounds(const core::TraceHeader& a, const core::TraceHeader& b);

  // One step of the body, whose magnitudes are those of our own frames; states agree with it as far as the bound goes.
  void advance(std::size_t body, const validation::BodyState& before, const validation::BodyState& after);

  [[nodiscard]] const FlightBound& of(std::size_t body) const { return bounds_[body]; }
  [[nodiscard]] const validation::BodyFacts& facts(std::size_t body) const { return facts_[body]; }
  // The orientation may be anything: by more than half a turn off.
  [[nodiscard]] bool has_outgrown(std::size_t body) const;

 private:
  void advance_turning(std::size_t body, const validation::BodyState& before, const validation::BodyState& after);

  double h_s_;
  double pull_m_s_;
  FlightParty parties_[2];
  bool is_one_integrator_;
  std::vector<validation::BodyFacts> facts_;
  std::vector<FlightBound> bounds_;
};

}  // namespace broadside::bench
