// The law of the GPU pipeline: at every frame its digest is octree-cpu's, bit for bit.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/engine/engine.hpp"
#include "core/method/frame_digest.hpp"
#include "gpu/engines.hpp"
#include "gpu/octree_gpu.hpp"
#include "reference/octree_cpu/engine.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using Given = std::map<std::string, std::string>;

core::Engine make(const core::EngineRow& row, const Given& given) {
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok()) << settings.error().line();
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok()) << engine.error().line();
  return std::move(engine).value();
}

// Names what differs first, in the order in which the pipeline makes it.
std::string first_difference(const core::FrameRecord& p, const core::FrameRecord& q) {
  if (p.detected_position != q.detected_position) return "positions at detection";
  if (p.boxes != q.boxes) return "boxes";
  if (p.confirmed != q.confirmed)
    return "confirmed pairs: " + std::to_string(p.confirmed.size()) + " against " + std::to_string(q.confirmed.size());
  if (p.proximity != q.proximity) return "nearest vertices";
  if (p.contacts.size() != q.contacts.size())
    return "contacts: " + std::to_string(p.contacts.size()) + " against " + std::to_string(q.contacts.size());
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    const core::Contact& c = p.contacts[k];
    const core::Contact& d = q.contacts[k];
    const std::string name =
        "contact " + std::to_string(k) + " (" + std::to_string(c.a) + ", " + std::to_string(c.b) + ")";
    if (c.a != d.a || c.b != d.b || c.color != d.color) return name + ": bodies or color";
    if (core::contact_digest(c) == core::contact_digest(d)) continue;
    if (c.depth_m != d.depth_m || c.normal != d.normal) return name + ": depth or normal";
    if (c.pre_a != d.pre_a || c.pre_b != d.pre_b) return name + ": state before";
    if (c.tangent != d.tangent) return name + ": tangent";
    if (c.normal_impulse_n_s != d.normal_impulse_n_s || c.tangent_impulse_n_s != d.tangent_impulse_n_s)
      return name + ": impulses";
    if (c.post_a.x != d.post_a.x || c.post_b.x != d.post_b.x) return name + ": positions after";
    if (c.post_a.v != d.post_a.v || c.post_b.v != d.post_b.v) return name + ": velocities after";
    return name + ": the sign of a zero";
  }
  if (p.position != q.position) return "positions";
  if (p.velocity != q.velocity) return "velocities";
  return "nothing that is recorded";
}

class Twin : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = octree_gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  }

  // Steps both for so many frames; ends at the first frame that differs. Returns all contacts seen, so that a test can
  // tell that something happened.
  static std::uint64_t compare(const core::Scene& scene, const Given& gpu, const Given& cpu, int frames) {
    EXPECT_TRUE(core::check_scene(scene).ok()) << core::check_scene(scene).error().line();
    core::Engine subject = make(octree_gpu_row(), gpu);
    core::Engine twin = make(reference::octree_cpu_row(), cpu);
    const auto good = [](const core::Status& s) {
      EXPECT_TRUE(s.ok()) << s.error().line();
      return s.ok();
    };
    if (!good(subject.dynamics->load(scene)) || !good(twin.dynamics->load(scene))) return 0;
    std::uint64_t contacts = 0;
    for (int k = 0; k < frames; ++k) {
      core::FrameRecord p;
      core::FrameRecord q;
      if (!good(subject.dynamics->step(scene.dt_s)) || !good(twin.dynamics->step(scene.dt_s))) return contacts;
      const auto level = k % 10 == 0 ? core::RecordLevel::kFull : core::RecordLevel::kDigest;
      if (!good(subject.dynamics->read_back(p, level)) || !good(twin.dynamics->read_back(q, level))) return contacts;
      contacts += p.contacts.size();
      if (p.digest == q.digest) continue;
      EXPECT_TRUE(subject.dynamics->read_back(p, core::RecordLevel::kFull).ok());
      EXPECT_TRUE(twin.dynamics->read_back(q, core::RecordLevel::kFull).ok());
      ADD_FAILURE() << "frame " << k + 1 << " differs in " << first_difference(p, q);
      return contacts;
    }
    return contacts;
  }

  static std::uint64_t compare(const core::Scene& scene, const Given& both, int frames) {
    return compare(scene, both, both, frames);
  }
};

core::Scene spheres(std::uint32_t bodies, float cube_m) {
  SceneShape shape;
  shape.bodies = bodies;
  shape.cube_m = cube_m;
  return thrown({bumpy_sphere(12, 0.5F), bumpy_sphere(25, 0.6F)}, shape);
}

TEST_F(Twin, EveryLevelFromItsPublishedStart) {
  for (const std::string levels : {"flat", "level1", "A", "B", "C"}) {
    SCOPED_TRACE(levels);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"levels", levels}}, 600), 0U);
  }
}

TEST_F(Twin, EveryLevelFromTheTree) {
  for (const std::string levels : {"flat", "level1", "A", "B", "C"}) {
    SCOPED_TRACE(levels);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "tree"}, {"levels", levels}},
                      {{"broad", "brute"}, {"levels", levels}}, 100),
              0U);
  }
}

TEST_F(Twin, WithoutTheVertexStage) {
  SceneShape shape;
  shape.bodies = 200;
  shape.cube_m = 5.0F;
  const core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F}), box_mesh({0.2F, 0.7F, 0.4F})}, shape);
  EXPECT_GT(compare(scene, {{"broad", "brute"}, {"vertex_stage", "off"}}, 600), 0U);
}

TEST_F(Twin, JacobiAndEveryPrintedFormOfTheResponse) {
  EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"solver", "jacobi"}}, 200), 0U);
  for (const std::string variant : {"printed-E3", "printed-E4", "printed-E5", "printed-E6"}) {
    SCOPED_TRACE(variant);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"variant", variant}}, 200), 0U);
  }
}

TEST_F(Twin, NoBodyAndOneBody) {
  compare(spheres(0, 4.0F), {{"broad", "brute"}}, 3);
  EXPECT_GT(compare(spheres(1, 4.0F), {{"broad", "brute"}}, 600), 0U);  // it meets the domain's faces
}

TEST_F(Twin, StaticBodies) {
  SceneShape shape;
  shape.static_every = 3;
  EXPECT_GT(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"broad", "brute"}}, 300), 0U);
  shape.static_every = 1;
  EXPECT_EQ(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"broad", "brute"}}, 3), 0U);
}

// 80 bodies at one point are 3160 contacts of one clique: more than 64 colors, so the words of colors must grow.
TEST_F(Twin, AllAtOnePoint) {
  SceneShape shape;
  shape.bodies = 80;
  shape.cube_m = 0.0F;
  core::Scene scene = thrown({bumpy_sphere(5, 0.5F)}, shape);
  scene.domain = {{-9, -9, -9}, {9, 9, 9}};
  EXPECT_GT(compare(scene, {{"broad", "brute"}}, 40), 0U);
}

// Above the size of brute force and of one block: the hashed octree, and every stage by the whole grid.
TEST_F(Twin, ThousandsOfBodiesOfManySizes) {
  SceneShape shape;
  shape.bodies = 5000;
  shape.cube_m = 14.0F;
  const core::Scene scene = thrown(
      {bumpy_sphere(6, 0.5F), bumpy_sphere(4, 0.2F), box_mesh({0.03F, 0.03F, 0.03F}), bumpy_sphere(40, 2.5F)}, shape);
  EXPECT_GT(compare(scene, {{"broad", "tree"}}, {{"broad", "brute"}}, 12), 0U);
}

TEST_F(Twin, RandomScenes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    SceneShape shape;
    shape.seed = seed;
    shape.bodies = 20 + static_cast<std::uint32_t>(200.0F * dice.next());
    shape.cube_m = 2.0F + 6.0F * dice.next();
    shape.speed_m_s = 20.0F * dice.next();
    shape.static_every = seed % 2 == 0 ? 7 : 0;
    const auto rings = 3 + static_cast<std::uint32_t>(20.0F * dice.next());
    const core::Scene scene =
        thrown({bumpy_sphere(rings, 0.3F + 0.5F * dice.next()), box_mesh({0.4F, 0.3F, 0.2F})}, shape);
    compare(scene, {{"broad", "tree"}}, {{"broad", "brute"}}, 100);
  }
}

}  // namespace
}  // namespace broadside::gpu
