// Narrow-phase engines under test, bodies whose distance is known, and what holds for every answer. Every engine
// of the table is a subject; those with settings or tolerances of their own have lines in listed_subjects().
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"
#include "tests/reference/subjects_of_the_table.hpp"

namespace broadside {

using core::Pose;
using core::Separation;
using core::Vec3;

struct NarrowPhaseSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings = {};
  // Solids: a body wholly inside another one touches it. Otherwise bodies are surfaces and it does not.
  bool is_solid = false;
  // By how much a distance may be off, relative to the size of the scene (about 1 m), and why.
  double tolerance = 1e-6;
  // Otherwise the distance of bodies apart is NaN and they have no normal; overlap has depth 0 and no normal.
  bool tells_distance = true;
  bool tells_depth = false;
  bool depth_is_least = false;  // otherwise it bounds the least depth from above
  bool is_boxes = false;        // takes bodies for their axis-aligned boxes
};

inline void PrintTo(const NarrowPhaseSubject& subject, std::ostream* out) {
  *out << subject.name;
}

// Float vertices and poses: a coordinate of about 4 m is off by up to 2^-22 = 2.4e-7 m after rounding, and a distance
// is made of two of them in each of three axes; 1e-6 covers it. Double inside adds nothing.
inline std::vector<NarrowPhaseSubject> listed_narrow_phase_subjects() {
  return {
      {"exact_mesh", reference::exact_mesh_row},
      {"exact_mesh_brute", reference::exact_mesh_row, {{"method", "surface-brute"}}},
      {"fcl_mesh", reference::fcl_mesh_row},
      // Stops refining at 1e-6 m.
      {"ccd_gjk", reference::ccd_row, {}, true, 1e-5, false, true, true},
      {"ccd_mpr", reference::ccd_row, {{"algorithm", "mpr"}}, true, 1e-5, false, true, false},
      {"ccd_gjk_box", reference::ccd_row, {{"shape", "box"}}, true, 1e-5, false, true, true, true},
      {"ccd_gjk_primitive", reference::ccd_row, {{"shape", "primitive"}}, true, 1e-5, false, true, true},
      {"exact_shapes", reference::exact_shapes_row, {}, true, 1e-6, true, true, true},
      {"fcl_shapes", reference::fcl_shapes_row, {}, true, 1e-5, true, true, true},
      {"fcl_shapes_collide", reference::fcl_shapes_row, {{"query", "collide"}}, true, 1e-5, true, true, true},
      {"fcl_shapes_indep", reference::fcl_shapes_row, {{"solver", "indep"}}, true, 1e-4, true, true, true},
      // Float inside, and EPA's own tolerance of 1e-4.
      {"bullet_shapes", reference::bullet_shapes_row, {}, true, 2e-4, true, true, true},
      {"bullet_shapes_margin", reference::bullet_shapes_row, {{"margin", "0.0001"}}, true, 4e-4, true, true, true},
      // Its GJK stops at 1e-6 m.
      {"fcl_box", reference::fcl_box_row, {}, true, 1e-5, true, true, true, true},
      // Float inside: some roundings of coordinates of up to 4 m.
      {"bullet_box", reference::bullet_box_row, {}, true, 1e-5, false, true, true, true},
  };
}

inline std::vector<NarrowPhaseSubject> narrow_phase_subjects() {
  return tests::with_unlisted(listed_narrow_phase_subjects(), "narrow");
}

inline core::Engine narrow_phase_engine(const NarrowPhaseSubject& subject) {
  const core::EngineRow row = subject.row();
  auto settings = core::Settings::parse(row.id, row.settings, subject.settings);
  EXPECT_TRUE(settings.ok());
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

// Vertices of a box around the origin, each face split into n x n squares of two triangles, so that its vertices can be
// far from where it is nearest.
inline core::Mesh box_mesh(Vec3 half, int n) {
  core::Mesh mesh;
  mesh.name = "box";
  mesh.source = "procedural";
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (int u = 0; u <= n; ++u) {
        for (int v = 0; v <= n; ++v) {
          Vec3 p;
          p[axis] = side * half[axis];
          p[(axis + 1) % 3] = half[(axis + 1) % 3] * (2.0F * static_cast<float>(u) / static_cast<float>(n) - 1.0F);
          p[(axis + 2) % 3] = half[(axis + 2) % 3] * (2.0F * static_cast<float>(v) / static_cast<float>(n) - 1.0F);
          mesh.vertices.push_back(p);
        }
      }
      const auto row = static_cast<std::uint32_t>(n + 1);
      for (std::uint32_t u = 0; u < row - 1; ++u) {
        for (std::uint32_t v = 0; v < row - 1; ++v) {
          const std::uint32_t k = first + u * row + v;
          mesh.triangles.push_back({k, k + row, k + row + 1});
          mesh.triangles.push_back({k, k + row + 1, k + 1});
        }
      }
    }
  }
  return mesh;
}

// An octahedron whose triangles were split and pushed out to the unit sphere `depth` times. Its six first vertices stay
// on the axes at distance 1, and all of it lies inside the unit ball.
inline core::Mesh sphere_mesh(int depth) {
  core::Mesh mesh;
  mesh.name = "sphere";
  mesh.source = "procedural";
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < depth; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto split = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] =
          middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        const Vec3 m = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back((1.0F / core::length(m)) * m);
      }
      return entry->second;
    };
    std::vector<core::Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = split(a, b);
      const std::uint32_t bc = split(b, c);
      const std::uint32_t ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

inline core::Scene scene_of(std::vector<core::Mesh> meshes) {
  core::Scene scene;
  scene.name = "narrow";
  for (core::Mesh& mesh : meshes) {
    core::Body body;
    body.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::make_shared<const core::Mesh>(std::move(mesh)));
    scene.bodies.push_back(body);
  }
  return scene;
}

class NarrowPhases : public testing::TestWithParam<NarrowPhaseSubject> {
 protected:
  Separation measure(std::vector<core::Mesh> meshes, const std::vector<Pose>& poses) {
    const core::Scene scene = scene_of(std::move(meshes));
    const auto loaded = phase().load(scene);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().line());
    const std::vector<core::Pair> pairs{{0, 1}};
    const auto measured = phase().measure(pairs, poses);
    EXPECT_TRUE(measured.ok()) << (measured.ok() ? "" : measured.error().line());
    auto result = phase().read_back();
    EXPECT_TRUE(result.ok());
    EXPECT_EQ(result.value().size(), 1U);
    return result.value().at(0);
  }

  // What holds for every answer about bodies apart by `distance`.
  void expect_apart(const Separation& s, double distance) const {
    EXPECT_FALSE(s.is_touching);
    if (!GetParam().tells_distance) {
      EXPECT_TRUE(std::isnan(s.distance_m));
      EXPECT_EQ(s.normal, Vec3{});
      return;
    }
    EXPECT_NEAR(s.distance_m, distance, tolerance());
    EXPECT_NEAR(core::length(s.normal), 1.0, 1e-6);
    const Vec3 between = s.witness_a - s.witness_b;
    EXPECT_NEAR(core::length(between), distance, 4.0 * tolerance());
    // From B to A: along the line from B's witness to A's.
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(s.normal[axis], between[axis] / core::length(between), 4.0 * tolerance() / distance);
  }

  [[nodiscard]] double tolerance() const { return GetParam().tolerance; }
  core::NarrowPhase& phase() { return *engine_.narrow_phase; }
  core::Engine engine_ = narrow_phase_engine(GetParam());
};

}  // namespace broadside
