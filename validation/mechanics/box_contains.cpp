#include <algorithm>
#include <limits>
#include <vector>

#include "core/scene/primitive.hpp"
#include "validation/mechanics/detection_pose.hpp"
#include "validation/mechanics/motion.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {
namespace {

// Vertices of meshes turned in one frame; with more, every k-th body, others in the next frame. Boxes, spheres and
// capsules need none.
constexpr std::size_t kMostVertices = 200'000;

class BoxContains final : public Validator {
 public:
  explicit BoxContains(const Subject& subject) : header_(subject.header) {
    for (const auto& mesh : header_.scene.meshes) {
      primitives_.push_back(core::primitive_of(*mesh));
      vertices_.push_back(primitives_.back() ? 0 : mesh->vertices.size());
    }
    std::size_t all = 0;
    for (const core::Body& b : header_.scene.bodies) all += vertices_[b.mesh];
    stride_ = all / kMostVertices + 1;
  }

  void look(const Evidence& evidence) override {
    if (evidence.motion == nullptr || evidence.frame.boxes.size() != evidence.motion->bodies.size()) return;
    const Motion& m = *evidence.motion;
    for (std::size_t i = 0; i < m.bodies.size(); ++i)
      if (vertices_[m.facts[i].mesh] == 0 || (i + m.step) % stride_ == 0) judge(m, evidence.frame, i);
  }

  core::Verdict conclude() override {
    return tally_.conclude("no frame with boxes and poses", "the largest box is " + number_text(waste_) +
                                                                " m wider than its shape" +
                                                                (stride_ > 1 ? "; not every mesh in every frame" : ""));
  }

 private:
  // Lowest and highest coordinate of the shape, relative to its origin.
  void extent(std::uint32_t mesh, const Mat3d& r, int axis, double& low, double& high) const {
    const Vec3d row = r.row[static_cast<std::size_t>(axis)];
    if (const auto& p = primitives_[mesh]) {
      const Vec3d half(p->half_extents);
      if (p->kind == core::PrimitiveKind::kBox) {
        high = std::abs(row.x) * half.x + std::abs(row.y) * half.y + std::abs(row.z) * half.z;
      } else if (p->kind == core::PrimitiveKind::kCylinder) {
        const double across = std::sqrt(std::max(0.0, 1.0 - row[p->axis] * row[p->axis]));
        high = p->half_length_m() * std::abs(row[p->axis]) + (p->radius_m - p->facet_gap_m) * across;
      } else {
        const double along = p->kind == core::PrimitiveKind::kCapsule ? p->half_length_m() : 0.0;
        high = p->radius_m + along * std::abs(row[p->axis]);
        // The drawing lies inside the shape that it stands for, by the gap of its facets.
        high -= p->facet_gap_m;
      }
      low = -high;
      return;
    }
    low = std::numeric_limits<double>::infinity();
    high = -low;
    for (const core::Vec3 v : header_.scene.meshes[mesh]->vertices) {
      const double at = dot(row, Vec3d(v));
      low = std::min(low, at);
      high = std::max(high, at);
    }
  }

  void judge(const Motion& m, const core::FrameRecord& frame, std::size_t i) {
    const auto pose = detection_pose(header_, frame, m, i);
    if (!pose) return;
    const BodyFacts& f = m.facts[i];
    const Mat3d r = matrix_of(pose->q);
    const core::Box& box = frame.boxes[i];
    for (int k = 0; k < 3; ++k) {
      double low = 0.0;
      double high = 0.0;
      extent(f.mesh, r, k, low, high);
      const double at = pose->origin[k];
      // Pose and box are recorded in float32; the pose's four components turn the shape.
      const double off =
          rounding(2) * std::abs(at) + rounding(24) * (f.reach_m + length(f.center_of_mass)) + kSubnormal;
      const double outside = std::max({0.0, box.min[k] - (at + low), (at + high) - box.max[k]});
      tally_.check(outside, {off, "m", kOrigin}, Where::body(m.step, static_cast<std::uint32_t>(i), "boxes"), [&] {
        return "the shape reaches from " + number_text(at + low) + " to " + number_text(at + high) +
               " m, the box from " + number_text(box.min[k]) + " to " + number_text(box.max[k]) + " m";
      });
      waste_ = std::max({waste_, (at + low) - box.min[k], box.max[k] - (at + high)});
    }
  }

  static constexpr std::string_view kOrigin = "rounding of the recorded pose and box (float32)";
  const core::TraceHeader& header_;
  std::vector<std::optional<core::Primitive>> primitives_;
  std::vector<std::size_t> vertices_;
  std::size_t stride_ = 1;
  double waste_ = 0.0;
  Tally tally_{"box-contains", "sides of boxes", kOrigin};
};

}  // namespace

ValidatorRow box_contains_row() {
  constexpr std::uint32_t kNeeded = core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection);
  return {"box-contains",
          "recorded boxes contain the exact shape at the pose of detection",
          "boxes that are one frame old; boxes of the shape before it turned",
          kNeeded | core::bit(core::Group::kDetectedOrientation),
          0,
          [](const Subject& subject) -> std::string {
            if (!subject.header.driver.empty()) return "the states come from another engine";
            return lacking(subject.header, core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection));
          },
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<BoxContains>(subject); },
          false,
          true};
}

}  // namespace broadside::validation
