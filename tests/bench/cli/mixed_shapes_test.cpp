// Heaps in which every shape meets every other one, as a user runs and judges them: the families of scenes have bodies
// of one shape each.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include "tests/bench/cli/judged_run.hpp"

namespace broadside::tests {
namespace {

constexpr const char* kShapes[] = {"cube", "brick", "sphere", "capsule", "cylinder", "stone"};

// 32 bodies of a meter and of 0.5 to 2 kg, turned at random, in two layers: they fall, or fly about without gravity
// between walls that give back all.
std::string mixed_heap(std::uint32_t seed, bool falls) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  std::string text = fmt::format(
      "name = \"mixed\"\nmotion = \"rigid\"\ndt_s = 0.0166666675\ngravity_m_s2 = [0.0, {}, 0.0]\n"
      "[domain]\nmin_m = [-4.0, 0.0, -4.0]\nmax_m = [4.0, 5.0, 4.0]\n"
      "[face_material]\nmu_static = 0.6\nmu_kinetic = 0.5\nrestitution = {}\n"
      "[material]\nmu_static = 0.6\nmu_kinetic = 0.5\nrestitution = 0.3\n",
      falls ? -9.81 : 0.0, falls ? 0.3 : 1.0);
  for (const char* shape : kShapes)
    text += fmt::format("[[mesh]]\nname = \"{0}\"\ncatalogue = \"{0}\"\nlongest_side_m = 1.0\n", shape);
  const auto vector = [&between](double half) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return fmt::format("[{}, {}, {}]", x, y, between(-half, half));
  };
  const double speed = falls ? 0.0 : 2.0;  // m/s, and rad/s
  for (int k = 0; k < 32; ++k) {
    const char* const shape = kShapes[random() % std::size(kShapes)];
    const double angle = between(0.0, 3.0);
    const double turn = between(0.0, 6.0);
    const double across = std::sin(angle);
    text += fmt::format("[[body]]\nmesh = \"{}\"\nmass_kg = {}\nposition_m = [{}, {}, {}]\n", shape, between(0.5, 2.0),
                        1.5 * (k % 4 - 1.5), 0.95 + 1.5 * (k / 16), 1.5 * (k / 4 % 4 - 1.5));
    text += fmt::format("orientation_wxyz = [{}, {}, {}, {}]\n", std::cos(angle), 0.6 * across,
                        0.8 * across * std::cos(turn), 0.8 * across * std::sin(turn));
    text += "velocity_m_s = " + vector(speed) + "\n";
    text += "angular_velocity_rad_s = " + vector(speed) + "\n";
  }
  return text;
}

TEST(MixedShapes, BreakNoLaw) {
  const ScratchFolder folder;
  for (const bool falls : {true, false})
    for (const std::uint32_t seed : {1U, 2U}) {
      const auto scene = folder / fmt::format("{}_{}.toml", falls ? "falls" : "flies", seed);
      std::ofstream(scene) << mixed_heap(seed, falls);
      holds_all_laws(scene.string(), "octree-cpu", "90");
    }
}

}  // namespace
}  // namespace broadside::tests
