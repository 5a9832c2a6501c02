// Spheres, boxes and capsules in positions whose signed distance is a formula of two lines: every engine of primitives
// against it, the arbiter first. The scene is turned as a whole, so that nothing is parallel to the world's axes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::Vec3;

struct ClosedFormSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings = {};
  // m, and the least cosine between its normal and the formula's. Float poses are off by 1e-7 m.
  double tolerance = 1e-6;
  double least_cosine = 1.0 - 1e-6;
  bool tells_distance = true;
  bool depth_is_least = true;    // otherwise an upper bound, along another direction
  bool dies_of_overlap = false;  // an assert of its library ends the process
};

void PrintTo(const ClosedFormSubject& subject, std::ostream* out) {
  *out << subject.name;
}

std::vector<ClosedFormSubject> closed_form_subjects() {
  return {
      {"exact_shapes", reference::exact_shapes_row},
      // Its iterations stop at a change of 1e-6 m of the squared distance; seen: 1e-5 m, and a degree.
      {"fcl_shapes", reference::fcl_shapes_row, {}, 1e-4, 0.999},
      {"fcl_shapes_indep", reference::fcl_shapes_row, {{"solver", "indep"}}, 1e-4, 0.999, true, true, true},
      {"fcl_shapes_collide", reference::fcl_shapes_row, {{"query", "collide"}}, 1e-4, 0.999},
      {"ccd_gjk", reference::ccd_row, {{"shape", "primitive"}}, 1e-5, 0.999, false},
      {"ccd_mpr", reference::ccd_row, {{"shape", "primitive"}, {"algorithm", "mpr"}}, 1e-5, 0.999, false, false},
      // Float inside, and EPA's own tolerance of 1e-4.
      {"bullet_shapes", reference::bullet_shapes_row, {}, 2e-4, 0.999},
  };
}

struct Placed {
  core::Mesh mesh;
  Vec3 position;
};

struct Known {
  std::string name;
  Placed a;
  Placed b;
  double distance_m;
  Vec3 normal;  // from B to A
};

core::Mesh mesh_of_sphere(double radius_m) {
  return datasets::sphere_mesh(radius_m, 8).value();
}
core::Mesh mesh_of_capsule(double radius_m, double half_length_m) {
  return datasets::capsule_mesh(radius_m, half_length_m, 8).value();
}
core::Mesh mesh_of_box(double x, double y, double z) {
  return datasets::box_mesh({x, y, z}, {1, 1, 1}).value();
}

// Apart and overlapping. Capsules lie along z.
std::vector<Known> known_pairs() {
  std::vector<Known> known;
  for (const double gap : {0.125, -0.0625}) {
    const auto up = [&](double touching) { return Vec3{0, static_cast<float>(touching + gap), 0}; };
    const std::string word = gap > 0.0 ? " apart" : " overlapping";
    const Vec3 down{0, -1, 0};
    known.push_back({"spheres" + word, {mesh_of_sphere(0.25), {}}, {mesh_of_sphere(0.5), up(0.75)}, gap, down});
    known.push_back(
        {"sphere over a face" + word, {mesh_of_box(1, 0.5, 1), {}}, {mesh_of_sphere(0.25), up(0.5)}, gap, down});
    known.push_back({"capsule over a face" + word,
                     {mesh_of_box(1, 0.5, 2), {}},
                     {mesh_of_capsule(0.25, 0.25), up(0.5)},
                     gap,
                     down});
    known.push_back({"sphere beside a capsule" + word,
                     {mesh_of_capsule(0.25, 0.5), {}},
                     {mesh_of_sphere(0.25), up(0.5)},
                     gap,
                     down});
    // Side by side, a quarter of their length shared: the least distance is that of the lines.
    Known side{"capsules side by side" + word,
               {mesh_of_capsule(0.25, 0.5), {}},
               {mesh_of_capsule(0.125, 0.5), up(0.375)},
               gap,
               down};
    side.b.position.z = 0.75F;
    known.push_back(side);
  }
  const auto corner = static_cast<float>(0.5 + 0.25 / std::sqrt(3.0));
  const auto diagonal = static_cast<float>(-1.0 / std::sqrt(3.0));
  known.push_back({"sphere off a corner",
                   {mesh_of_box(1, 1, 1), {}},
                   {mesh_of_sphere(0.125), {corner, corner, corner}},
                   0.125,
                   {diagonal, diagonal, diagonal}});
  known.push_back({"sphere off a capsule's end",
                   {mesh_of_capsule(0.25, 0.5), {}},
                   {mesh_of_sphere(0.25), {0, 0, 1.25F}},
                   0.25,
                   {0, 0, -1}});
  return known;
}

class ClosedForm : public testing::TestWithParam<ClosedFormSubject> {};

TEST_P(ClosedForm, SpheresBoxesAndCapsules) {
  const ClosedFormSubject& subject = GetParam();
  const core::EngineRow row = subject.row();
  core::Engine engine =
      std::move(row.create(core::Settings::parse(row.id, row.settings, subject.settings).value())).value();
  const core::Quat q{0.5F, 0.1F, -0.7F, 0.5F};  // length 1
  for (const Known& pair : known_pairs()) {
    if (pair.distance_m < 0.0 && subject.dies_of_overlap) continue;
    for (const bool is_swapped : {false, true}) {
      SCOPED_TRACE(pair.name + (is_swapped ? ", swapped" : ""));
      const Placed& first = is_swapped ? pair.b : pair.a;
      const Placed& second = is_swapped ? pair.a : pair.b;
      core::Scene scene;
      scene.meshes = {std::make_shared<const core::Mesh>(first.mesh), std::make_shared<const core::Mesh>(second.mesh)};
      scene.bodies.resize(2);
      scene.bodies[1].mesh = 1;
      ASSERT_TRUE(engine.narrow_phase->load(scene).ok());
      const std::vector<core::Pose> poses{{core::rotate(q, first.position), q}, {core::rotate(q, second.position), q}};
      ASSERT_TRUE(engine.narrow_phase->measure(std::vector<core::Pair>{{0, 1}}, poses).ok());
      const core::Separation s = engine.narrow_phase->read_back().value().at(0);
      EXPECT_EQ(s.is_touching, pair.distance_m < 0.0);
      if (pair.distance_m > 0.0 && !subject.tells_distance) {
        EXPECT_TRUE(std::isnan(s.distance_m));
        continue;
      }
      if (!subject.depth_is_least) {
        EXPECT_LE(s.distance_m, pair.distance_m + subject.tolerance);
        continue;
      }
      EXPECT_NEAR(s.distance_m, pair.distance_m, subject.tolerance);
      const Vec3 normal = core::rotate(q, (is_swapped ? -1.0F : 1.0F) * pair.normal);
      EXPECT_GT(core::dot(s.normal, normal), subject.least_cosine);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, ClosedForm, testing::ValuesIn(closed_form_subjects()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside
