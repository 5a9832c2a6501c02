// Bodies that touch nothing.
#include <array>

#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;
using core::WrenchAxes;

Scene brick(double seconds) {
  Scene scene = rigid_scene("torque-free", 0.001, seconds);
  scene.gravity_m_s2 = {};
  core::Body& b = add_box(scene, {0.1, 0.4, 0.9}, {0, 25, 0}, 10.0);
  b.angular_velocity = {0.1F, 5.0F, 0.1F};
  return scene;
}

Scene tumbling() {
  return brick(10.0);
}

// Symmetric about y: the axis rotates about L at L / I1.
Scene top() {
  Scene scene = rigid_scene("top", 0.001, 2.0);
  scene.gravity_m_s2 = {};
  core::Body& b = add_box(scene, {0.4, 0.1, 0.4}, {0, 25, 0}, 2.0);
  b.angular_velocity = {1.5F, 8.0F, 0.0F};
  return scene;
}

Scene thrown() {
  Scene scene = rigid_scene("flight", 1.0 / 240.0, 1.5);
  core::Body& b = add_box(scene, {0.5, 0.25, 1.0}, {-5, 20, 0}, 2.0);
  b.velocity = {4, 6, -1};
  b.angular_velocity = {1, 2, 0.5F};
  return scene;
}

// F / m = (3, 2, -1) m/s^2 in addition to gravity.
Scene pushed() {
  Scene scene = rigid_scene("flight", 1.0 / 240.0, 1.5);
  add_ball(scene, 0.5, {0, 25, 0}, 2.0).velocity = {1, 2, 0};
  scene.wrenches = {{0, WrenchAxes::kWorld, {6, 4, -2}, {}}};
  return scene;
}

// A torque about a principal axis: w = w0 + T t / I.
Scene wound_up() {
  Scene scene = rigid_scene("spin-up", 1.0 / 240.0, 2.0);
  scene.gravity_m_s2 = {};
  add_box(scene, {0.5, 0.25, 1.0}, {0, 25, 0}, 3.0).angular_velocity = {0, 1, 0};
  scene.wrenches = {{0, WrenchAxes::kBody, {}, {0, 0.5F, 0}}};
  return scene;
}

constexpr std::array<SmallSceneRow, 5> kFreeRows{{
    {"rigid:flight:box", "a box thrown, turning: x0 + v0 t + g t^2 / 2", thrown},
    {"rigid:flight:pushed", "a ball pushed by a constant force in flight", pushed},
    {"rigid:torque-free:box", "a free brick that starts near its middle axis: Jacobi's functions, period 6.05684 s",
     tumbling},
    {"rigid:torque-free:top", "a free symmetric top: its axis goes round L at L / I1", top},
    {"rigid:spin-up", "a free box under a constant torque about a principal axis: w0 + T t / I", wound_up},
}};

}  // namespace

std::span<const SmallSceneRow> free_scenes() {
  return kFreeRows;
}

}  // namespace broadside::datasets
