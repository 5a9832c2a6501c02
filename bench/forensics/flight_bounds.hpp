// How far two correct engines may differ in a body that flies freely: the sum, step after step, of the rounding and
// truncation errors that each may have.
#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/trace_header.hpp"
#include "validation/mechanics/motion.hpp"

namespace broadside::bench {

// What an engine declares that bounds its free flight.
struct FlightParty {
  explicit FlightParty(const core::TraceHeader& header);

  double roundoff = 0.0;  // of its arithmetic or of its record, whichever is coarser
  double substeps = 1.0;
  double order = 1.0;
  double pull_operations = 1;  // rounded operations in computing h g
};

// The allowance of one body: the largest difference that a component may have.
struct FlightBound {
  double velocity_m_s = 0.0;
  double position_m = 0.0;  // of the center of mass
  double momentum_kg_m2_s = 0.0;
  double spin_rad_s = 0.0;
  double angle_rad = 0.0;
};

// Rounding, in each engine: the additions to v and x in each substep, and the operations behind h g.
// Position: an engine of order 1 moves a body by h times a velocity between those at the start and at the end of the
// step, so at most h^2 g / 2 from the exact parabola, and 1/n of that in n substeps. An engine of order 2 or more is
// exact for a constant force. Engines that declare the same integrator, order and number of substeps truncate alike.
// Turning: in a step the laws gyroscopic and turning allow h |w x L| / 2 of the angular momentum and h |dw| +
// (h |w|)^3 / 12 of the angle; each order above the first is another factor h |w|. An error of momentum or angle
// becomes one of spin, and that becomes one of angle. So the bound grows until it bounds nothing: neighboring motions
// of a free body diverge.
class FlightBounds {
 public:
  FlightBounds(const core::TraceHeader& a, const core::TraceHeader& b);

  // Adds one step of the body. Its magnitudes are taken from our own frames; the other engine's agree within the bound.
  void advance(std::size_t body, const validation::BodyState& before, const validation::BodyState& after);

  [[nodiscard]] const FlightBound& of(std::size_t body) const { return bounds_[body]; }
  [[nodiscard]] const validation::BodyFacts& facts(std::size_t body) const { return facts_[body]; }
  // The bound on the angle has reached half a turn, so the orientation may be anything.
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
