// Pairs of bodies for the agreement study: random, but deliberately spread over separations and degeneracies. Each pair
// has the arbiter's answer.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/engine/narrow_phase.hpp"
#include "core/exact/convex_core.hpp"
#include "core/exact/triangle_tree.hpp"
#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::bench {

enum class PairKind { kBoxes, kSpheres, kCapsules, kConvex, kMeshes, kKissing };
inline constexpr std::string_view kPairKinds[] = {"boxes", "spheres", "capsules", "convex", "meshes", "kissing"};

enum class Degeneracy { kNone, kThinPlate, kNeedle, kParallelFaces, kCoincidentCenters };
inline constexpr std::string_view kDegeneracies[] = {"general", "thin plate", "needle", "parallel faces",
                                                     "coincident centers"};

// Classes by signed distance. With s the least half side of both bodies' boxes, the classes are: below -s/4, from there
// to the touching band, in the band, from there to s, and above s.
enum class Separated { kDeep, kShallow, kTouching, kNear, kFar };
inline constexpr std::string_view kSeparations[] = {"deep", "shallow", "touching band", "near", "far"};

// Half the width of the touching band, and the error that an answer may have, m: a tenth of the method's slop of 1 mm
// (P-Table 1). Below the slop no response differs.
inline constexpr double kTouchingBand_m = 1e-4;

struct TestPair {
  std::uint32_t mesh_a = 0;  // indices into PairSource::meshes()
  std::uint32_t mesh_b = 0;
  core::Pose pose_a;
  core::Pose pose_b;
  Degeneracy degeneracy = Degeneracy::kNone;
  // The arbiter's distance: signed for convex bodies, 0 where the surfaces of meshes meet.
  double distance_m = 0.0;
  exact::Point normal;  // unit, from B to A; zero where meshes meet
  Separated separation = Separated::kFar;
};

// The same kind, seed and index always give the same pair.
class PairSource {
 public:
  // mesh: a name of the catalogue that both bodies use, with kMeshes alone; empty = lumpy bodies of 320 triangles.
  static core::Result<PairSource> make(PairKind kind, std::uint64_t seed, const std::string& mesh);
  // A source of one given pair.
  static core::Result<PairSource> of_case(const std::vector<std::shared_ptr<const core::Mesh>>& meshes, bool is_convex);

  TestPair pair(std::uint64_t index);
  // Computes the arbiter's answer for a pair whose poses are set.
  void arbitrate(TestPair& pair);

  [[nodiscard]] const std::vector<std::shared_ptr<const core::Mesh>>& meshes() const { return meshes_; }
  [[nodiscard]] bool has_depth() const { return is_convex_; }
  // How far A must move along a unit direction, from B to A, to part from B. For convex bodies only.
  [[nodiscard]] double overlap_along(const TestPair& pair, exact::Point direction) const;

 private:
  struct Draw;

  core::Status add_shapes(const std::string& mesh);
  core::Status add(core::Result<core::Mesh> mesh);
  void place(TestPair& pair, Draw& draw, std::uint64_t index);
  double move_to(TestPair& pair, exact::Point along, exact::Point offset, double target);
  const exact::TriangleTree& tree(std::uint32_t mesh, core::Quat q);

  PairKind kind_ = PairKind::kBoxes;
  std::uint64_t seed_ = 0;
  bool is_convex_ = true;
  std::vector<std::shared_ptr<const core::Mesh>> meshes_;
  std::vector<double> reach_m_;       // farthest vertex from the origin
  std::vector<double> least_half_m_;  // least half side of the box
  std::vector<exact::ConvexCore> cores_;
  // Trees of turned meshes. Each mesh has few orientations, because a tree of a large mesh takes a second to build.
  std::vector<std::pair<core::Quat, std::unique_ptr<exact::TriangleTree>>> trees_;
  std::vector<std::uint32_t> mesh_of_tree_;
  // Ranges of meshes_: general shapes first, then plates, then needles.
  std::uint32_t general_ = 0;
  std::uint32_t plates_ = 0;
  std::uint32_t needles_ = 0;
};

}  // namespace broadside::bench
