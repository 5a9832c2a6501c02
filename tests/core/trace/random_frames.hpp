// Scenes and frames with every bit pattern that a float may have, for tests that compare bits.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::tests {

using core::bit;
using core::Group;

constexpr std::uint32_t kAllGroups = bit(Group::kBodies) | bit(Group::kDetection) | bit(Group::kPairs) |
                                     bit(Group::kConfirmed) | bit(Group::kContacts) | bit(Group::kNarrow) |
                                     bit(Group::kOctree) | bit(Group::kBodyOctree) | bit(Group::kPoints) |
                                     bit(Group::kDetectedOrientation) | bit(Group::kPartPoses);

inline core::Scene tetrahedra_scene(std::uint32_t bodies) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "tetrahedron";
  mesh->source = "procedural";
  mesh->is_stand_in = true;
  mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  auto other = std::make_shared<core::Mesh>(*mesh);
  other->name = "second, \xC3\xA9t\xC3\xA9";
  other->source = "";
  other->is_stand_in = false;
  other->vertices.push_back({-0.0F, 0.1F, -1e-40F});
  core::Scene scene;
  scene.name = "test:tetrahedra";
  scene.description = "Tetrahedra that go nowhere.";
  scene.meshes = {mesh, other};
  scene.domain = {{-10, -10, -10}, {10, 10, 10}};
  scene.gravity_m_s2 = {0, 0, -9.81F};
  scene.frames = 300;
  scene.seed = 0xFEDCBA9876543210U;
  scene.parameters.theta_m = 0.03125F;
  scene.parameters.alpha = 0.75F;
  scene.face_material = {0.5F, 0.25F, 1.0F};
  scene.answer = "none";
  for (std::uint32_t i = 0; i < bodies; ++i) {
    core::Body body;
    body.mesh = i % 2;
    body.position = {static_cast<float>(i) * 0.1F, -0.0F, 1e-45F};
    body.orientation = i % 3 == 0 ? core::Quat{0, 1, 0, 0} : core::Quat{};
    body.velocity = {0.1F, 0.2F, -0.3F};
    body.angular_velocity = {0, 0, static_cast<float>(i)};
    body.inverse_mass = i % 4 == 0 ? 0.0F : 1.0F / static_cast<float>(i);
    body.material = {0.6F, 0.1F * static_cast<float>(i % 5), 0.5F};
    scene.bodies.push_back(body);
  }
  if (bodies > 1)
    scene.springs = {
        {1, {0.5F, -0.0F, 3.0F}, 100.0F, 0.25F}, {1, {0, 1, 0}, 1e-40F, 0.0F}, {1, {}, 2, 1}, {1, {}, 0, 0}};
  if (bodies > 1)
    scene.wrenches = {{1, core::WrenchAxes::kBody, {0.25F, -0.0F, 1e-40F}, {}},
                      {1, core::WrenchAxes::kWorld, {0, 0, 3}, {}},
                      {1, core::WrenchAxes::kBody, {0, 2, 0}, {}},
                      {1, core::WrenchAxes::kWorld, {1, 0, 0}, {}},
                      {1, core::WrenchAxes::kWorld, {}, {}}};
  return scene;
}

inline core::TraceHeader header_of(core::Scene scene, std::uint32_t groups) {
  core::TraceHeader header;
  header.stamp = {scene.name, core::scene_digest(scene), "octree-cpu",          "levels=C;broad=tree", "levels=C",
                  "build 1",  "broadside 0.1.0",         "a machine, no device"};
  header.declaration = core::Declaration::of({{"method", "octree-aabb"}, {"motion", "translate"}});
  header.scene = std::move(scene);
  header.groups = groups;
  header.every = 2;
  header.broad_is_exact = false;
  header.broad_margin_m = 0.05;
  header.driver = "octree-cpu";
  header.notes = {{"theta_m", "0.0312"}, {"empty", ""}, {"seed of the grid", "17"}};
  return header;
}

// Any bits: NaN with payloads, both zeros, infinities and subnormals come up, since the exponent is drawn from few.
class Bits {
 public:
  explicit Bits(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t n) { return n == 0 ? 0 : static_cast<std::uint32_t>(random_() % n); }
  float real() {
    constexpr std::uint32_t kExponents[] = {0x00000000U, 0x7F800000U, 0x3F800000U, 0x40000000U, 0x3D000000U};
    const auto bits = static_cast<std::uint32_t>(random_());
    switch (below(8)) {
      case 0:
        return std::bit_cast<float>(bits & 0x80000000U);  // +0, -0
      case 1:
        return std::bit_cast<float>((bits & 0x80000000U) | 0x7F800000U);  // infinities
      default:
        return std::bit_cast<float>((bits & 0x807FFFFFU) | kExponents[below(5)]);
    }
  }
  core::Vec3 vec() { return {real(), real(), real()}; }
  core::Kinematics kinematics() { return {vec(), vec()}; }
  core::Pair pair(std::uint32_t bodies) { return core::make_pair_of(below(bodies), below(bodies)); }
  std::uint64_t word() { return random_(); }

 private:
  std::mt19937_64 random_;
};

inline core::Contact random_contact(Bits& bits, std::uint32_t bodies) {
  core::Contact c;
  c.a = bits.below(bodies);
  const bool face = bits.below(4) == 0;
  c.b = face ? core::kFirstFace + bits.below(core::kFaceCount) : bits.below(bodies);
  c.color = face ? core::kFaceColor : bits.below(9);
  c.depth_m = bits.real();
  c.normal = bits.vec();
  c.normal_impulse_n_s = bits.real();
  c.tangent = bits.vec();
  c.tangent_impulse_n_s = bits.real();
  c.pre_a = bits.kinematics();
  c.pre_b = bits.kinematics();
  c.post_a = bits.kinematics();
  c.post_b = bits.kinematics();
  return c;
}

// Some frames are empty, some have no proximities.
inline core::FrameRecord random_frame(Bits& bits, std::uint64_t step, std::uint32_t bodies, std::uint32_t groups) {
  const auto has = [groups](Group g) { return (groups & bit(g)) != 0U; };
  const bool is_empty = bodies == 0 || bits.below(5) == 0;
  core::FrameRecord f;
  f.step = step;
  f.time_s = static_cast<double>(step) / 60.0;
  f.digest = bits.word();
  for (std::uint32_t i = 0; i < bodies; ++i) {
    if (has(Group::kBodies)) {
      f.position.push_back(bits.vec());
      f.orientation.push_back({bits.real(), bits.real(), bits.real(), bits.real()});
      f.velocity.push_back(bits.vec());
      f.angular_velocity.push_back(bits.vec());
    }
    if (has(Group::kDetection)) {
      f.detected_position.push_back(bits.vec());
      f.detected_velocity.push_back(bits.vec());
      f.boxes.push_back({bits.vec(), bits.vec()});
    }
    if (has(Group::kDetectedOrientation))
      f.detected_orientation.push_back({bits.real(), bits.real(), bits.real(), bits.real()});
  }
  const auto rows = [&] { return is_empty ? 0U : bits.below(40); };
  if (has(Group::kPairs)) {
    for (std::uint32_t i = rows(); i > 0; --i) f.pairs.push_back(bits.pair(bodies));
    f.pairs_demanded = bits.word();
    f.pairs_raw = bits.word();
  }
  if (has(Group::kConfirmed)) {
    const bool vertices_on = bits.below(3) != 0;
    for (std::uint32_t i = rows(); i > 0; --i) {
      f.confirmed.push_back(bits.pair(bodies));
      if (!vertices_on) continue;
      core::Proximity p;
      if (bits.below(2) == 0) p = {bits.real(), bits.below(4), bits.below(4)};
      f.proximity.push_back(p);
    }
  }
  if (has(Group::kContacts))
    for (std::uint32_t i = rows(); i > 0; --i) f.contacts.push_back(random_contact(bits, bodies));
  if (has(Group::kPoints)) {
    f.parts = bits.below(5);
    for (std::uint32_t i = rows(); i > 0; --i) {
      const core::Contact like = random_contact(bits, bodies);
      f.points.push_back({like.a, like.b, bits.vec(), bits.vec(), bits.real(), bits.vec(), bits.below(9)});
    }
  }
  if (has(Group::kPartPoses))
    for (std::uint32_t i = rows(); i > 0; --i)
      f.part_poses.push_back({bits.vec(), {bits.real(), bits.real(), bits.real(), bits.real()}});
  if (has(Group::kNarrow))
    for (std::uint32_t i = rows(); i > 0; --i) {
      f.measured.push_back(bits.pair(bodies));
      f.separations.push_back(
          {std::bit_cast<double>(bits.word()), bits.below(2) == 0, bits.vec(), bits.vec(), bits.vec()});
    }
  if (has(Group::kOctree)) {
    for (std::uint32_t i = rows(); i > 0; --i)
      f.octree_nodes.push_back({{bits.vec(), bits.vec()}, bits.below(4), bits.below(9), bits.below(9), bits.below(9)});
    for (std::uint32_t i = 0; i < bodies; ++i) f.octree_node_of_body.push_back(bits.below(73));
  }
  if (has(Group::kBodyOctree)) {
    for (std::uint32_t i = rows(); i > 0; --i) f.shape_of_body.push_back(bits.below(5));
    for (std::uint32_t i = rows(); i > 0; --i) f.body_octree_boxes.push_back({bits.vec(), bits.vec()});
    for (std::uint32_t i = rows(); i > 0; --i) f.leaf_of_vertex.push_back(bits.below(64));
  }
  return f;
}

template <typename T>
bool same_bits(const std::vector<T>& p, const std::vector<T>& q) {
  return p.size() == q.size() && (p.empty() || std::memcmp(p.data(), q.data(), p.size() * sizeof(T)) == 0);
}

// "" when every bit agrees, else the name of the first member that does not. (Separation has padding bytes.)
inline std::string first_difference(const core::FrameRecord& p, const core::FrameRecord& q) {
  if (p.step != q.step) return "step";
  if (std::bit_cast<std::uint64_t>(p.time_s) != std::bit_cast<std::uint64_t>(q.time_s)) return "time_s";
  if (p.digest != q.digest) return "digest";
  if (!same_bits(p.position, q.position)) return "position";
  if (!same_bits(p.orientation, q.orientation)) return "orientation";
  if (!same_bits(p.velocity, q.velocity)) return "velocity";
  if (!same_bits(p.angular_velocity, q.angular_velocity)) return "angular_velocity";
  if (!same_bits(p.detected_position, q.detected_position)) return "detected_position";
  if (!same_bits(p.detected_velocity, q.detected_velocity)) return "detected_velocity";
  if (!same_bits(p.boxes, q.boxes)) return "boxes";
  if (!same_bits(p.pairs, q.pairs)) return "pairs";
  if (p.pairs_demanded != q.pairs_demanded) return "pairs_demanded";
  if (p.pairs_raw != q.pairs_raw) return "pairs_raw";
  if (!same_bits(p.confirmed, q.confirmed)) return "confirmed";
  if (!same_bits(p.proximity, q.proximity)) return "proximity";
  if (!same_bits(p.contacts, q.contacts)) return "contacts";
  if (!same_bits(p.points, q.points)) return "points";
  if (p.parts != q.parts) return "parts";
  if (!same_bits(p.detected_orientation, q.detected_orientation)) return "detected_orientation";
  if (!same_bits(p.wide.position, q.wide.position)) return "wide.position";
  if (!same_bits(p.wide.orientation, q.wide.orientation)) return "wide.orientation";
  if (!same_bits(p.wide.velocity, q.wide.velocity)) return "wide.velocity";
  if (!same_bits(p.wide.angular_velocity, q.wide.angular_velocity)) return "wide.angular_velocity";
  if (!same_bits(p.measured, q.measured)) return "measured";
  if (!same_bits(p.octree_nodes, q.octree_nodes)) return "octree_nodes";
  if (!same_bits(p.octree_node_of_body, q.octree_node_of_body)) return "octree_node_of_body";
  if (!same_bits(p.shape_of_body, q.shape_of_body)) return "shape_of_body";
  if (!same_bits(p.body_octree_boxes, q.body_octree_boxes)) return "body_octree_boxes";
  if (!same_bits(p.leaf_of_vertex, q.leaf_of_vertex)) return "leaf_of_vertex";
  if (p.separations.size() != q.separations.size()) return "separations";
  for (std::size_t i = 0; i < p.separations.size(); ++i) {
    const core::Separation& a = p.separations[i];
    const core::Separation& b = q.separations[i];
    if (std::bit_cast<std::uint64_t>(a.distance_m) != std::bit_cast<std::uint64_t>(b.distance_m)) return "distance_m";
    if (a.is_touching != b.is_touching) return "is_touching";
    if (std::memcmp(&a.normal, &b.normal, 3 * sizeof(core::Vec3)) != 0) return "normal or witnesses";
  }
  return "";
}

// An empty folder that is removed when it goes out of scope.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "broadside-trace-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace broadside::tests
