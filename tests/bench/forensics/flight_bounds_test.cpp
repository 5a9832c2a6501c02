// The bound on two engines in free flight against closed forms.
#include "bench/forensics/flight_bounds.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "datasets/shapes/box_mesh.hpp"

namespace broadside::bench {
namespace {

using validation::BodyState;

core::TraceHeader header_with(const std::map<std::string, std::string>& declared) {
  core::TraceHeader header;
  header.scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({0.2, 0.4, 0.8}, {1, 1, 1}).value())};
  header.scene.bodies.resize(1);
  header.scene.gravity_m_s2 = {0, -10, 0};
  header.scene.dt_s = 0.125F;
  header.scene.motion = core::Motion::kRigid;
  header.declaration = core::Declaration::of(declared);
  return header;
}

double position_after(const core::TraceHeader& a, const core::TraceHeader& b, int steps) {
  FlightBounds bounds(a, b);
  for (int k = 0; k < steps; ++k) bounds.advance(0, {}, {});
  return bounds.of(0).position_m;
}

// Explicit and semi-implicit Euler are h^2 g apart after each step: 0.15625 m.
TEST(FlightBounds, TwoFirstOrderEnginesMayBeHSquaredGApartAStep) {
  const auto one = header_with({{"order", "1"}});
  const auto two = header_with({{"order", "2"}});
  const double apart = 0.125 * 0.125 * 10.0;
  EXPECT_NEAR(position_after(one, one, 8), 8 * apart, 1e-4);
  EXPECT_NEAR(position_after(one, two, 8), 8 * apart / 2, 1e-4);
  EXPECT_LT(position_after(two, two, 8), 1e-4) << "a constant force is exact: rounding alone";
  EXPECT_GT(position_after(two, two, 8), 0.0);
  EXPECT_NEAR(position_after(header_with({{"order", "1"}, {"substeps", "10"}}), two, 8), 8 * apart / 20, 1e-4);
}

TEST(FlightBounds, OneIntegratorTruncatesAlike) {
  const auto a = header_with({{"integrator", "semi-implicit Euler"}});
  EXPECT_LT(position_after(a, a, 8), 1e-4);
  const auto method = header_with({{"method", "octree-aabb"}});
  EXPECT_LT(position_after(method, method, 8), 1e-4);
}

// The bound for a tumbling brick grows until it says nothing; for a body that does not turn only rounding is left.
TEST(FlightBounds, OfTurningGrowsToHalfATurn) {
  const auto header = header_with({{"order", "1"}});
  FlightBounds bounds(header, header);
  BodyState still;
  for (int k = 0; k < 100; ++k) bounds.advance(0, still, still);
  EXPECT_LT(bounds.of(0).angle_rad, 0.01);
  EXPECT_FALSE(bounds.has_outgrown(0));
  BodyState turning;
  turning.w = {0.2, 3.0, 0.1};
  turning.angular_momentum = {0.2 * bounds.facts(0).largest_moment, 3.0 * bounds.facts(0).least_moment, 0.0};
  int steps = 0;
  while (!bounds.has_outgrown(0) && steps < 1000) bounds.advance(0, turning, turning), ++steps;
  EXPECT_GT(steps, 1);
  EXPECT_LT(steps, 1000);
  EXPECT_GE(bounds.of(0).angle_rad, std::numbers::pi);
}

}  // namespace
}  // namespace broadside::bench
