// Moving bodies for the motion study, each test with the arbiter's interval for the first touch.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/agree/motion/motion_test.hpp"
#include "core/exact/rigid_touch.hpp"
#include "core/result.hpp"

namespace broadside::bench {

class BodySource {
 public:
  // Shapes as `agree --pairs` draws them for that kind. mesh: as there, used with kMeshes alone.
  static core::Result<BodySource> make(MotionKind kind, std::uint64_t seed, const std::string& mesh);
  static BodySource of_meshes(Meshes meshes, bool are_solid);

  // The same kind, seed and index always give the same test.
  [[nodiscard]] MotionTest test(std::uint64_t index) const;
  // Computes the arbiter's answer for a test whose motions are set.
  void arbitrate(MotionTest& test) const;

  [[nodiscard]] const Meshes& meshes() const { return meshes_; }
  [[nodiscard]] bool are_solid() const { return are_solid_; }
  [[nodiscard]] double reach_m(std::uint32_t mesh) const { return shapes_[mesh].reach_m(); }

 private:
  void graze(MotionTest& test, exact::Point beside, double gap_m) const;

  std::uint64_t seed_ = 0;
  bool are_solid_ = true;
  Meshes meshes_;
  std::vector<exact::MovingShape> shapes_;
  std::vector<std::uint32_t> general_;
  std::vector<std::uint32_t> thin_;  // plates and needles; the general shapes where there are none
};

}  // namespace broadside::bench
