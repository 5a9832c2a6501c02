#include "validation/octree_invariants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/math/quat.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {
namespace {

using core::Box;
using core::OctreeNode;

constexpr std::uint32_t kMaxLevel = 2;  // the paper's MAX_LEVEL, METHOD 2
constexpr std::size_t kBodyNodes = 73;  // 1 + 8 + 64
constexpr std::string_view kCellOrigin =
    "a coordinate's cell is 4 operations from the domain's lower face: 4 u offset + 2 u |face| (float32)";
constexpr std::string_view kTightOrigin = "P-Alg A1: the tight box of the node's vertices, minima and maxima of floats";

class OctreeInvariants final : public Validator {
 public:
  explicit OctreeInvariants(const Subject& subject) : header_(subject.header), scene_(header_.scene) {}

  void look(const Evidence& evidence) override {
    step_ = evidence.frame.step;
    if (has(header_, core::Group::kOctree) && judge_nodes(evidence.frame.octree_nodes)) {
      ++scene_octrees_;
      judge_bodies(evidence.frame);
    }
    if (has(header_, core::Group::kBodyOctree)) judge_shapes(evidence.frame);
  }

  core::Verdict conclude() override {
    if (has(header_, core::Group::kBodyOctree) && seen_ && told_ == 0 && !scene_.bodies.empty())
      tally_.require(false, "body octrees are recorded once, with the first frame", Where::frame(step_, "body_octree"));
    return tally_.conclude("no frames", std::to_string(scene_octrees_) + " scene octrees, " + std::to_string(shapes_) +
                                            " body octrees over " + std::to_string(vertices_) + " vertices");
  }

 private:
  bool judge_nodes(const std::vector<OctreeNode>& nodes) {
    const Where where = Where::frame(step_, "octree.nodes");
    if (!tally_.require(!nodes.empty() && nodes[0].level == 0 && nodes[0].parent == core::kNoNode,
                        "METHOD 2: node 0 is the root, level 0 without a parent", where))
      return false;
    tally_.require(nodes[0].box == scene_.domain, "METHOD 2: the root cell is the domain", where);
    bool is_sound = true;
    std::vector<std::uint8_t> adopted(nodes.size(), 0);
    for (std::uint32_t k = 0; k < nodes.size(); ++k) {
      const std::uint32_t wanted = nodes[k].level < kMaxLevel ? 8 : 0;
      const double missing = std::abs(static_cast<double>(nodes[k].child_count) - wanted);
      tally_.check(missing, {0.0, "children", "METHOD 2, E7: eight children above MAX_LEVEL = 2, none at it"},
                   Where::frame(step_, "octree.child_count"));
      is_sound &= judge_children(nodes, k, adopted);
    }
    for (std::uint32_t k = 1; k < nodes.size(); ++k)
      is_sound &= tally_.require(adopted[k] == 1, "METHOD 2: every node but the root is the child of one node",
                                 Where::frame(step_, "octree.parent"));
    return is_sound;
  }

  bool judge_children(const std::vector<OctreeNode>& nodes, std::uint32_t k, std::vector<std::uint8_t>& adopted) {
    const OctreeNode& node = nodes[k];
    if (node.child_count == 0) return true;
    const Where where = Where::frame(step_, "octree.first_child");
    if (!tally_.require(node.child_count <= 8 && node.first_child < nodes.size() &&
                            node.child_count <= nodes.size() - node.first_child,
                        "METHOD 2: children are nodes of this octree", where))
      return false;
    // The plane at which the halves of each axis meet: the first child is the lower one on all three.
    const core::Vec3 middle = nodes[node.first_child].box.max;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = node.box.min[axis];
      const double high = node.box.max[axis];
      tally_.check(std::abs(middle[axis] - 0.5 * (low + high)),
                   {rounding(1) * 0.5 * std::abs(low + high), "m",
                    "METHOD 2: halves meet in the middle, one addition (float32)"},
                   Where::frame(step_, "octree.box"));
    }
    bool is_sound = true;
    for (std::uint32_t octant = 0; octant < node.child_count; ++octant) {
      const OctreeNode& child = nodes[node.first_child + octant];
      adopted[node.first_child + octant] += 1;
      is_sound &= tally_.require(child.parent == k && child.level == node.level + 1,
                                 "METHOD 2: a child names its parent and is one level down", where);
      bool tiles = true;
      for (int axis = 0; axis < 3; ++axis) {
        const bool is_upper = (octant >> static_cast<unsigned>(axis) & 1U) != 0;
        tiles &= child.box.min[axis] == (is_upper ? middle[axis] : node.box.min[axis]);
        tiles &= child.box.max[axis] == (is_upper ? node.box.max[axis] : middle[axis]);
      }
      tally_.require(tiles, "METHOD 2: children tile their parent", Where::frame(step_, "octree.box"));
    }
    return is_sound;
  }

  void judge_bodies(const core::FrameRecord& frame) {
    if (frame.boxes.size() != scene_.bodies.size()) return;
    if (!tally_.require(frame.octree_node_of_body.size() == scene_.bodies.size(), "one node per body of the scene",
                        Where::frame(step_, "octree.node_of_body")))
      return;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const Where where = Where::body(step_, i, "octree.node_of_body");
      const std::uint32_t k = frame.octree_node_of_body[i];
      if (!tally_.require(k < frame.octree_nodes.size(), "a body is stored in a node of this octree", where)) continue;
      judge_place(frame.octree_nodes, k, frame.boxes[i], where);
    }
  }

  void judge_place(const std::vector<OctreeNode>& nodes, std::uint32_t k, const Box& box, const Where& where) {
    bool is_inside = true;
    for (int axis = 0; axis < 3; ++axis)
      is_inside &= box.min[axis] >= scene_.domain.min[axis] && box.max[axis] <= scene_.domain.max[axis];
    if (!is_inside) {
      tally_.require(k == 0, "METHOD 2: a body outside the domain is in the root", where);
      return;
    }
    const OctreeNode& node = nodes[k];
    tally_.check(-room_in(node.box, box), {band(node.box, box), "m", kCellOrigin}, where);
    double deepest = -std::numeric_limits<double>::infinity();
    const OctreeNode* lower = nullptr;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      const OctreeNode& child = nodes[node.first_child + c];
      if (room_in(child.box, box) > deepest) deepest = room_in(child.box, box), lower = &child;
    }
    if (lower == nullptr) return;
    // How far inside a child the box is: it should have been stored there.
    tally_.check(deepest, {band(lower->box, box), "m", kCellOrigin}, where);
  }

  // The least distance of the box from the cell's faces; negative when the box sticks out. The domain's faces contain
  // boxes that touch them, so they do not count.
  [[nodiscard]] double room_in(const Box& cell, const Box& box) const {
    double room = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (cell.min[axis] != scene_.domain.min[axis])
        room = std::min(room, static_cast<double>(box.min[axis]) - cell.min[axis]);
      if (cell.max[axis] != scene_.domain.max[axis])
        room = std::min(room, static_cast<double>(cell.max[axis]) - box.max[axis]);
    }
    return room;
  }

  [[nodiscard]] double band(const Box& cell, const Box& box) const {
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double offset = static_cast<double>(box.max[axis]) - scene_.domain.min[axis];
      const double face = std::max(std::abs(cell.min[axis]), std::abs(cell.max[axis]));
      most = std::max(most, rounding(4) * offset + rounding(2) * face);
    }
    return most;
  }

  void judge_shapes(const core::FrameRecord& frame) {
    seen_ = true;
    if (frame.shape_of_body.empty() && frame.body_octree_boxes.empty() && frame.leaf_of_vertex.empty()) return;
    ++told_;
    const Where where = Where::frame(step_, "body_octree.shape");
    if (!tally_.require(frame.shape_of_body.size() == scene_.bodies.size(), "one shape per body of the scene", where))
      return;
    // The first body of each shape is checked for all of them.
    std::vector<std::uint32_t> first;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const std::uint32_t shape = frame.shape_of_body[i];
      if (!tally_.require(shape <= first.size(), "shapes are numbered in the order of their first body", where)) return;
      if (shape == first.size()) first.push_back(i);
      const core::Body& one = scene_.bodies[first[shape]];
      const core::Body& body = scene_.bodies[i];
      tally_.require(one.mesh == body.mesh && one.orientation == body.orientation,
                     "bodies of one shape have one mesh and orientation", Where::body(step_, i, "body_octree.shape"));
    }
    std::size_t vertices = 0;
    for (const std::uint32_t body : first) vertices += scene_.meshes[scene_.bodies[body].mesh]->vertices.size();
    if (!tally_.require(frame.body_octree_boxes.size() == kBodyNodes * first.size(), "73 boxes a shape",
                        Where::frame(step_, "body_octree.box")) ||
        !tally_.require(frame.leaf_of_vertex.size() == vertices, "P-Alg A1: every vertex has exactly one leaf",
                        Where::frame(step_, "body_octree.leaf")))
      return;
    std::size_t next = 0;
    for (std::size_t shape = 0; shape < first.size(); ++shape) {
      const core::Body& body = scene_.bodies[first[shape]];
      const std::size_t count = scene_.meshes[body.mesh]->vertices.size();
      judge_shape(first[shape], frame.body_octree_boxes.data() + kBodyNodes * shape,
                  frame.leaf_of_vertex.data() + next);
      next += count;
      vertices_ += count;
    }
    shapes_ += first.size();
  }

  // boxes: 73, root, level 1, leaves. leaves: one per vertex.
  void judge_shape(std::uint32_t body, const Box* boxes, const std::uint32_t* leaves) {
    const auto& vertices = scene_.meshes[scene_.bodies[body].mesh]->vertices;
    std::vector<Box> tight(kBodyNodes, core::empty_box());
    const Where where = Where::body(step_, body, "body_octree.leaf");
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (!tally_.require(leaves[v] < 64, "P-Alg A1: a vertex is in one of 64 leaves", where)) return;
      const core::Vec3 at = core::rotate(scene_.bodies[body].orientation, vertices[v]);
      for (const std::size_t node : {std::size_t{0}, std::size_t{1} + leaves[v] / 8, std::size_t{9} + leaves[v]})
        tight[node] = core::grown(tight[node], at);
      judge_cell(boxes[0], at, leaves[v], where);
    }
    for (std::size_t node = 0; node < kBodyNodes; ++node) {
      const bool is_same = core::is_empty(tight[node]) ? core::is_empty(boxes[node]) : tight[node] == boxes[node];
      tally_.require(is_same, kTightOrigin, Where::body(step_, body, "body_octree.box"));
    }
  }

  // The leaf's cell, from halving the root's box twice.
  void judge_cell(const Box& root, core::Vec3 vertex, std::uint32_t leaf, const Where& where) {
    double outside = 0.0;
    double error = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      double low = root.min[axis];
      double high = root.max[axis];
      for (const std::uint32_t octant : {leaf / 8, leaf % 8}) {
        const double middle = 0.5 * (low + high);
        ((octant >> static_cast<unsigned>(axis) & 1U) != 0 ? low : high) = middle;
      }
      outside = std::max({outside, low - vertex[axis], vertex[axis] - high});
      error = std::max(error, rounding(2) * std::max(std::abs(root.min[axis]), std::abs(root.max[axis])));
    }
    tally_.check(outside, {error, "m", "P-Alg A1: a vertex is in its leaf's cell, two halvings of the root (float32)"},
                 where);
  }

  const core::TraceHeader& header_;
  const core::Scene& scene_;
  std::uint64_t step_ = 0;
  bool seen_ = false;
  std::uint64_t told_ = 0;
  std::uint64_t scene_octrees_ = 0;
  std::uint64_t shapes_ = 0;
  std::uint64_t vertices_ = 0;
  Tally tally_{"octree-invariants", "properties of octrees",
               "METHOD 2: children tile their parent, and each body and vertex is in its lowest cell"};
};

std::string why_not_octree_invariants(const Subject& subject) {
  const bool has_any = has(subject.header, core::Group::kOctree) || has(subject.header, core::Group::kBodyOctree);
  return has_any ? "" : "the trace records no octree";
}

}  // namespace

ValidatorRow octree_invariants_row() {
  return {
      "octree-invariants",
      "children tile their parent, every body is in the lowest node that contains it, every vertex in exactly one leaf",
      "printed-E7; a body one level too high; a vertex in no leaf or in a wrong one",
      core::bit(core::Group::kOctree) | core::bit(core::Group::kBodyOctree) | core::bit(core::Group::kDetection),
      0,
      why_not_octree_invariants,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<OctreeInvariants>(subject); }};
}

}  // namespace broadside::validation
