// Other people's engines of rigid bodies behind our interface, against closed forms: do adapters hand over what their
// libraries compute, with our signs, in our frames, as totals of a step? Expected values are worked out here.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::FrameRecord;
using core::WideVec3;

struct RigidWorldSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings = {};
  double rounding = 1e-12;  // of sums over a few hundred steps in its precision, relative
  // Set to false for Bullet, which brakes bodies before they touch, so that the rest of a slow impact has no
  // restitution.
  bool keeps_restitution = true;
};

void PrintTo(const RigidWorldSubject& subject, std::ostream* out) {
  *out << subject.name;
}

// The subjects that this build has.
std::vector<RigidWorldSubject> rigid_world_subjects() {
  std::vector<RigidWorldSubject> all{
      {"bullet", reference::bullet_world_row, {}, 1e-4, false},
      {"ode_quick", reference::ode_world_row},
      {"ode_dantzig", reference::ode_world_row, {{"solver", "dantzig"}}},
      {"mujoco", reference::mujoco_world_row},
      {"mujoco_elliptic", reference::mujoco_world_row, {{"tuning", "recommended"}}},
      {"mujoco_implicit", reference::mujoco_world_row, {{"integrator", "implicit"}}},
      {"mujoco_rk4", reference::mujoco_world_row, {{"integrator", "rk4"}}},
      {"dart", reference::dart_world_row},
      {"dart_own", reference::dart_world_row, {{"detector", "dart"}}},
      {"simbody", reference::simbody_world_row},
  };
  std::erase_if(all, [](const RigidWorldSubject& s) { return !s.row().absent().empty(); });
  return all;
}

std::shared_ptr<const core::Mesh> shifted_box(double x, double y, double z, core::Vec3 shift = {}) {
  core::Mesh mesh = datasets::box_mesh({x, y, z}, {1, 1, 1}).value();
  for (core::Vec3& v : mesh.vertices) v = v + shift;
  return std::make_shared<const core::Mesh>(std::move(mesh));
}

std::shared_ptr<const core::Mesh> octahedron() {
  core::Mesh mesh;
  mesh.name = "octahedron";
  mesh.vertices = {{0.5F, 0, 0}, {-0.5F, 0, 0}, {0, 0.5F, 0}, {0, -0.5F, 0}, {0, 0, 0.5F}, {0, 0, -0.5F}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return std::make_shared<const core::Mesh>(std::move(mesh));
}

core::Scene one_body_scene(std::shared_ptr<const core::Mesh> mesh, float dt_s) {
  core::Scene scene;
  scene.name = "test";
  scene.meshes = {std::move(mesh)};
  scene.domain = {{-50, 0, -50}, {50, 100, 50}};
  scene.gravity_m_s2 = {0, -8, 0};
  scene.dt_s = dt_s;
  scene.motion = core::Motion::kRigid;
  scene.face_material = {0.5F, 0.5F, 0.0F};
  scene.bodies.resize(1);
  scene.bodies[0].material = scene.face_material;
  return scene;
}

WideVec3 position(const FrameRecord& f, std::size_t i) {
  return f.wide.position.empty() ? WideVec3{f.position[i].x, f.position[i].y, f.position[i].z} : f.wide.position[i];
}
WideVec3 velocity(const FrameRecord& f, std::size_t i) {
  return f.wide.velocity.empty() ? WideVec3{f.velocity[i].x, f.velocity[i].y, f.velocity[i].z} : f.wide.velocity[i];
}
WideVec3 spin(const FrameRecord& f, std::size_t i) {
  const core::Vec3 w = f.angular_velocity[i];
  return f.wide.angular_velocity.empty() ? WideVec3{w.x, w.y, w.z} : f.wide.angular_velocity[i];
}

// v in the axes of a body of orientation q: q* v q, written out.
WideVec3 in_body_axes(const core::Quat& f, const FrameRecord& frame, WideVec3 v) {
  const core::WideQuat q =
      frame.wide.orientation.empty() ? core::WideQuat{f.w, f.x, f.y, f.z} : frame.wide.orientation[0];
  const WideVec3 u{-q.x, -q.y, -q.z};
  const auto cross = [](WideVec3 a, WideVec3 b) {
    return WideVec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const WideVec3 t = cross(u, v);
  const WideVec3 s = cross(u, t);
  return {v.x + 2 * (q.w * t.x + s.x), v.y + 2 * (q.w * t.y + s.y), v.z + 2 * (q.w * t.z + s.z)};
}

class RigidWorlds : public testing::TestWithParam<RigidWorldSubject> {
 protected:
  [[nodiscard]] static core::Engine make() {
    const core::EngineRow row = GetParam().row();
    auto engine = row.create(core::Settings::parse(row.id, row.settings, GetParam().settings).value());
    EXPECT_TRUE(engine.ok());
    return std::move(engine).value();
  }

  // Every frame; a scene that the engine says it does not support leaves none.
  std::vector<FrameRecord> run(const core::Scene& scene, int steps) {
    std::vector<FrameRecord> frames;
    const core::Status loaded = engine_.dynamics->load(scene);
    if (!loaded.ok()) {
      EXPECT_NE(loaded.error().what.find("unsupported"), std::string::npos) << loaded.error().line();
      return frames;
    }
    for (int k = 0; k < steps; ++k) {
      const core::Status stepped = engine_.dynamics->step(scene.dt_s);
      EXPECT_TRUE(stepped.ok()) << (stepped.ok() ? "" : stepped.error().line());
      if (!stepped.ok()) break;
      EXPECT_TRUE(engine_.dynamics->read_back(frames.emplace_back(), core::RecordLevel::kFull).ok());
    }
    return frames;
  }

  [[nodiscard]] bool records_points() const { return (engine_.dynamics->groups() & bit(core::Group::kPoints)) != 0; }
  [[nodiscard]] bool is_compliant() const { return engine_.declaration.is_compliant(); }

  core::Engine engine_ = make();
};

// After n steps v = n g h exactly; x lies between the sums of explicit and of semi-implicit Euler steps.
TEST_P(RigidWorlds, FreeFallGainsGravity) {
  core::Scene scene = one_body_scene(shifted_box(1, 1, 1), 1.0F / 64.0F);
  scene.bodies[0].position = {1, 50, 2};
  scene.bodies[0].velocity = {0.5F, 0, -1};
  const auto frames = run(scene, 32);
  ASSERT_EQ(frames.size(), 32U);
  const double near = 50 * GetParam().rounding;
  EXPECT_NEAR(velocity(frames.back(), 0).y, -8.0 * 32 / 64, near);
  EXPECT_NEAR(velocity(frames.back(), 0).x, 0.5, near);
  EXPECT_NEAR(position(frames.back(), 0).x, 1.25, near);
  EXPECT_NEAR(position(frames.back(), 0).z, 1.5, near);
  EXPECT_LE(position(frames.back(), 0).y, 50.0 - 8.0 * 31 * 32 / 2 / 4096 + near);
  EXPECT_GE(position(frames.back(), 0).y, 50.0 - 8.0 * 32 * 33 / 2 / 4096 - near);
  EXPECT_EQ(frames.back().step, 32U);
  EXPECT_EQ(frames.back().time_s, 0.5);
}

// For a ball, v = (g + F / m) t and w = T t / I, with a force and a torque in the world and others in the body's axes.
// The latter keep their direction, because the spin is about the torques' own axis.
TEST_P(RigidWorlds, AWrenchPushesAndTurns) {
  core::Mesh ball = datasets::sphere_mesh(0.5, 8).value();
  core::Scene scene = one_body_scene(std::make_shared<const core::Mesh>(std::move(ball)), 1.0F / 64.0F);
  scene.bodies[0].position = {0, 50, 0};
  scene.bodies[0].inverse_mass = 0.5F;
  scene.wrenches = {{0, core::WrenchAxes::kWorld, {0, 6, 0}, {0, 0.125F, 0}},
                    {0, core::WrenchAxes::kBody, {0, 2, 0}, {0, 0.25F, 0}}};
  const auto frames = run(scene, 32);
  ASSERT_EQ(frames.size(), 32U);
  const double near = 50 * GetParam().rounding;
  EXPECT_NEAR(velocity(frames.back(), 0).y, (-8.0 + 8.0 / 2) * 0.5, near);
  const double moment = 0.4 * 2.0 * 0.25;  // 2/5 m r^2
  EXPECT_NEAR(spin(frames.back(), 0).y, 0.375 / moment * 0.5, near);
  EXPECT_NEAR(spin(frames.back(), 0).x, 0.0, near);
}

// Euler's equations for the free brick of RIGID 6, solved by small Runge-Kutta steps of this test's own; w is in body
// axes.
WideVec3 exact_spin(double seconds) {
  // 10 kg of 0.1 x 0.4 x 0.9 m.
  const std::array<double, 3> moment{10.0 / 12 * (0.16 + 0.81), 10.0 / 12 * (0.01 + 0.81), 10.0 / 12 * (0.01 + 0.16)};
  using Spin = std::array<double, 3>;
  const auto rate = [&](const Spin& w) {
    return Spin{(moment[1] - moment[2]) * w[1] * w[2] / moment[0], (moment[2] - moment[0]) * w[2] * w[0] / moment[1],
                (moment[0] - moment[1]) * w[0] * w[1] / moment[2]};
  };
  const auto moved = [](const Spin& w, const Spin& r, double s) {
    return Spin{w[0] + s * r[0], w[1] + s * r[1], w[2] + s * r[2]};
  };
  constexpr double kStep = 1e-4;
  // The initial values, as the scene has them in float32.
  Spin w{0.1F, 5.0F, 0.1F};
  for (int k = 0; k < static_cast<int>(std::lround(seconds / kStep)); ++k) {
    const Spin a = rate(w);
    const Spin b = rate(moved(w, a, 0.5 * kStep));
    const Spin c = rate(moved(w, b, 0.5 * kStep));
    const Spin d = rate(moved(w, c, kStep));
    for (std::size_t i = 0; i < 3; ++i) w[i] += kStep / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return {w[0], w[1], w[2]};
}

TEST_P(RigidWorlds, AFreeBrickTurnsAsEulersEquationsSay) {
  const auto error_with = [&](int steps_a_second) {
    core::Scene scene = one_body_scene(shifted_box(0.1, 0.4, 0.9), 1.0F / static_cast<float>(steps_a_second));
    scene.gravity_m_s2 = {};
    scene.bodies[0].position = {0, 50, 0};
    scene.bodies[0].inverse_mass = 0.1F;
    scene.bodies[0].angular_velocity = {0.1F, 5.0F, 0.1F};
    const auto frames = run(scene, steps_a_second);
    const WideVec3 w = in_body_axes(frames.back().orientation[0], frames.back(), spin(frames.back(), 0));
    const WideVec3 e = exact_spin(1.0);
    return std::hypot(w.x - e.x, w.y - e.y, w.z - e.z);
  };
  const double coarse = error_with(1024);
  const double fine = error_with(2048);
  if (engine_.declaration.number("order") > 1.0) {
    EXPECT_LT(coarse, 5.0 / 1024 / 1024);  // second order in h = 1/1024 s, of a spin of 5 rad/s
    return;
  }
  // First order: half the step gives half the error, or less. Without the gyroscopic torque the error would be as large
  // as the spin.
  EXPECT_LT(coarse, 0.1 * 5.0);
  EXPECT_LT(fine, std::max(0.6 * coarse, 1e-4));
}

TEST_P(RigidWorlds, TheFloorCarriesTheWeightOfARestingBox) {
  core::Scene scene = one_body_scene(shifted_box(1, 0.5, 0.75), 1.0F / 128.0F);
  scene.bodies[0].position = {0, 0.25F, 0};
  scene.bodies[0].inverse_mass = 0.5F;
  const auto frames = run(scene, 512);
  ASSERT_EQ(frames.size(), 512U);
  EXPECT_NEAR(position(frames.back(), 0).y, 0.25, is_compliant() ? 0.02 : 0.005);
  EXPECT_NEAR(position(frames.back(), 0).x, 0.0, 0.005);
  if (!records_points()) return;
  double carried = 0.0;
  double moment_x = 0.0;
  double moment_z = 0.0;
  for (std::size_t k = 256; k < 512; ++k)
    for (const core::ContactPoint& p : frames[k].points) {
      EXPECT_EQ(p.a, 0U);
      EXPECT_EQ(p.b, core::kFirstFace + 2) << "-y";
      EXPECT_NEAR(p.normal.y, 1.0, 1e-3) << "inward";
      EXPECT_NEAR(p.point.y, 0.0, 0.01);
      carried += p.impulse.y;
      moment_x += p.impulse.y * p.point.x;
      moment_z += p.impulse.y * p.point.z;
    }
  // m g h a step; for engines that jitter, the excess and the lack cancel within a few steps.
  EXPECT_NEAR(carried / 256, 2.0 * 8.0 / 128, 0.01 * 2.0 * 8.0 / 128);
  EXPECT_NEAR(moment_x / carried, 0.0, 0.01) << "the weight acts below the center";
  EXPECT_NEAR(moment_z / carried, 0.0, 0.01);
}

// m dv = m g h + sum J, body by body and step by step, with the signs of either order of the two bodies.
TEST_P(RigidWorlds, ImpulsesAreWhatBodiesWereGiven) {
  for (const bool lower_first : {true, false}) {
    core::Scene scene = one_body_scene(shifted_box(1, 1, 1), 1.0F / 128.0F);
    scene.bodies.resize(2, scene.bodies[0]);
    scene.bodies[lower_first ? 0 : 1].position = {0, 0.52F, 0};
    scene.bodies[lower_first ? 1 : 0].position = {0.25F, 1.6F, 0.125F};
    scene.bodies[0].inverse_mass = 0.5F;
    scene.bodies[0].velocity = {0.75F, 0, -0.5F};
    const auto frames = run(scene, 96);
    if (frames.empty() || !records_points()) return;
    const double mass[2] = {2.0, 1.0};
    double pushed = 0.0;
    for (std::size_t k = 1; k < frames.size(); ++k) {
      double given[2][3] = {};
      for (const core::ContactPoint& p : frames[k].points) {
        const bool is_pair = !core::is_face(p.b);
        ASSERT_LT(p.a, p.b);
        EXPECT_GE(p.normal.x * p.impulse.x + p.normal.y * p.impulse.y + p.normal.z * p.impulse.z, -1e-6)
            << "from B to A: contacts push";
        const double j[3] = {p.impulse.x, p.impulse.y, p.impulse.z};
        for (int axis = 0; axis < 3; ++axis) {
          given[p.a][axis] += j[axis];
          if (is_pair) given[p.b][axis] -= j[axis];
        }
        if (is_pair) pushed += std::abs(j[1]);
      }
      for (std::size_t i = 0; i < 2; ++i) {
        const WideVec3 v0 = velocity(frames[k - 1], i);
        const WideVec3 v1 = velocity(frames[k], i);
        // Points are recorded in float32.
        const double near = 1e-6 + 10 * GetParam().rounding;
        EXPECT_NEAR(mass[i] * (v1.x - v0.x), given[i][0], near) << GetParam().name << " step " << k << " body " << i;
        EXPECT_NEAR(mass[i] * (v1.y - v0.y), given[i][1] - mass[i] * 8 / 128, near) << "step " << k << " body " << i;
        EXPECT_NEAR(mass[i] * (v1.z - v0.z), given[i][2], near) << "step " << k << " body " << i;
        if (testing::Test::HasFailure()) return;
      }
    }
    EXPECT_GT(pushed, 0.0) << "the two met";
  }
}

// A ball that falls by 1/2 m at 1 m/s^2 meets the floor at 1 m/s: v' = -e v.
TEST_P(RigidWorlds, ABallBouncesAsTheSceneSaysOrTheCardDoes) {
  core::Scene scene =
      one_body_scene(std::make_shared<const core::Mesh>(datasets::sphere_mesh(0.25, 8).value()), 1.0F / 512.0F);
  scene.gravity_m_s2 = {0, -1, 0};
  scene.bodies[0].position = {0, 0.75F, 0};
  scene.bodies[0].material = scene.face_material = {0.0F, 0.0F, 0.5F};
  double fastest = 0.0;
  for (const FrameRecord& f : run(scene, 700)) fastest = std::max(fastest, velocity(f, 0).y);
  for (const core::EquivalenceFact& fact : engine_.equivalence(scene)) {
    if (fact.property != "restitution rule") continue;
    const bool has_none = fact.engine.starts_with("none");
    const bool has_dissipation = fact.engine.starts_with("dissipation");
    EXPECT_LT(fastest, has_dissipation ? 0.75 : 0.51);
    if (!GetParam().keeps_restitution) return;
    // The dissipation matches e only to first order in c v = 1/2, so the error is within its square.
    EXPECT_NEAR(fastest, has_none ? 0.0 : 0.5, has_none || has_dissipation ? 0.25 : 0.01);
    return;
  }
  FAIL() << "the card says nothing about restitution";
}

// The center of mass of a body that spins freely stays, though the mesh's origin is elsewhere and circles.
TEST_P(RigidWorlds, ABodySpinsAboutItsCenterOfMass) {
  core::Scene scene = one_body_scene(shifted_box(0.5, 0.25, 1, {0.75F, 0.125F, 0}), 1.0F / 256.0F);
  if (GetParam().name.starts_with("dart") || GetParam().name == "simbody") {
    // The shapes of these engines must lie about the origin, so the scene gives the center of mass instead.
    scene.meshes = {shifted_box(0.5, 0.25, 1)};
    scene.mass_properties = {{{0.125, 0, 0}, {0.1, 0.2, 0.15, 0, 0, 0}}};
  }
  scene.gravity_m_s2 = {};
  scene.bodies[0].position = {0, 50, 0};
  scene.bodies[0].angular_velocity = {0, 2, 0};
  const auto center = core::mass_properties_of(scene, 0).value().center_of_mass_m;
  const auto frames = run(scene, 200);
  ASSERT_EQ(frames.size(), 200U);
  double farthest = 0.0;
  for (const FrameRecord& f : frames) {
    const core::Quat q = f.orientation[0];
    const core::Vec3 arm =
        core::rotate(q, {static_cast<float>(center[0]), static_cast<float>(center[1]), static_cast<float>(center[2])});
    const WideVec3 x = position(f, 0);
    EXPECT_NEAR(x.x + arm.x, center[0], 1e-5);
    EXPECT_NEAR(x.y + arm.y, 50 + center[1], 1e-5);
    EXPECT_NEAR(x.z + arm.z, center[2], 1e-5);
    farthest = std::max(farthest, std::hypot(x.x, x.z));
  }
  // 200 / 256 s at 2 rad/s: the origin is a chord of 1.5625 rad away.
  EXPECT_NEAR(farthest, 2 * std::abs(center[0]) * std::sin(0.5 * 1.5625), 0.02);
}

TEST_P(RigidWorlds, BodiesThatTranslateKeepTheirOrientation) {
  core::Scene scene = one_body_scene(shifted_box(1, 1, 1), 1.0F / 128.0F);
  scene.motion = core::Motion::kTranslate;
  scene.bodies[0].position = {0, 0.75F, 0};
  scene.bodies[0].velocity = {2, 0, 0};
  scene.bodies[0].orientation = {0.8F, 0.0F, 0.6F, 0.0F};
  const auto frames = run(scene, 128);
  ASSERT_EQ(frames.size(), 128U);
  EXPECT_EQ(frames.back().orientation[0], scene.bodies[0].orientation) << "bit by bit";
  EXPECT_EQ(frames.back().angular_velocity[0], core::Vec3{});
  EXPECT_NEAR(position(frames.back(), 0).y, 0.5, 0.02);
  EXPECT_LT(velocity(frames.back(), 0).x, 1.0) << "friction acts";
}

TEST_P(RigidWorlds, AConvexBodyLiesOnItsFaceOrIsUnsupported) {
  core::Scene scene = one_body_scene(octahedron(), 1.0F / 128.0F);
  // On a face: turned by the angle between (1, 1, 1) and (0, -1, 0) about (1, 0, -1).
  const double half = 0.5 * std::acos(-1.0 / std::sqrt(3.0));
  const auto s = static_cast<float>(std::sin(half) / std::sqrt(2.0));
  scene.bodies[0].orientation = {static_cast<float>(std::cos(half)), s, 0.0F, -s};
  const double height = 0.5 / std::sqrt(3.0);
  scene.bodies[0].position = {0, static_cast<float>(height) + 0.002F, 0};
  const auto frames = run(scene, 256);
  if (frames.empty()) return;
  EXPECT_NEAR(position(frames.back(), 0).y, height, is_compliant() ? 0.02 : 0.01);
  EXPECT_LT(std::abs(velocity(frames.back(), 0).y), 8.0 / 128);
}

TEST_P(RigidWorlds, SameSceneSameBits) {
  core::Scene scene = one_body_scene(shifted_box(1, 0.5, 0.75), 1.0F / 64.0F);
  if (GetParam().name != "simbody") scene.bodies.resize(6, scene.bodies[0]);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    scene.bodies[i].position = {0.3F * static_cast<float>(i), 1.0F + static_cast<float>(i), 0.2F};
    scene.bodies[i].angular_velocity = {1.0F, static_cast<float>(i), -2.0F};
  }
  const auto first = run(scene, 60);
  const auto second = run(scene, 60);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k) ASSERT_EQ(first[k].digest, second[k].digest) << "step " << k + 1;
}

INSTANTIATE_TEST_SUITE_P(Reference, RigidWorlds, testing::ValuesIn(rigid_world_subjects()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside
