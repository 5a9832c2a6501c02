// Boxes on a plane and on each other, with patches at their corners: the rig that tests of contact solvers step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/contact.hpp"
#include "core/material.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/rigid_state.hpp"
#include "reference/octree_cpu/rigid/contact_solver.hpp"

namespace broadside::reference {

struct BoxRig {
  std::vector<core::RigidState> states;
  std::vector<core::RigidMass> masses;
  std::vector<core::Material> materials;
  std::vector<core::Vec3> half_sides_m;
  std::vector<core::ContactPatch> patches;  // of the last step
  core::Material face_material;
  core::Vec3 gravity_m_s2{0.0F, -9.81F, 0.0F};
  float dt_s = 1.0F / 60.0F;

  std::uint32_t add(core::Vec3 half, core::Vec3 x, float mass_kg, const core::Material& material) {
    core::RigidMass mass;
    mass.inverse_mass = 1.0F / mass_kg;
    const auto inverse = [&](float p, float q) { return 3.0F / (mass_kg * (p * p + q * q)); };
    mass.inverse_inertia = {inverse(half.y, half.z), inverse(half.x, half.z), inverse(half.x, half.y), 0, 0, 0};
    core::RigidState state;
    state.x = x;
    states.push_back(state);
    masses.push_back(mass);
    materials.push_back(material);
    half_sides_m.push_back(half);
    face_material = material;
    return static_cast<std::uint32_t>(states.size() - 1);
  }

  // Adds a patch of the four corners of box a that are lowest over a plane, where one of them is nearer than reach_m.
  void meet(std::uint32_t a, std::uint32_t b, core::Vec3 normal, core::Vec3 on_plane, float reach_m) {
    struct Corner {
      float gap;
      std::uint32_t feature;
      core::Vec3 at;
    };
    std::array<Corner, 8> corners;
    for (std::uint32_t k = 0; k < 8; ++k) {
      const core::Vec3 h = half_sides_m[a];
      const core::Vec3 local{(k & 1U) != 0U ? h.x : -h.x, (k & 2U) != 0U ? h.y : -h.y, (k & 4U) != 0U ? h.z : -h.z};
      const core::Vec3 at = core::rotate(states[a].q, local);
      corners[k] = {core::dot(normal, at + (states[a].x - on_plane)), k + 1, at};
    }
    std::stable_sort(corners.begin(), corners.end(), [](const Corner& p, const Corner& q) { return p.gap < q.gap; });
    if (corners[0].gap > reach_m) return;
    core::ContactPatch patch;
    patch.a = a;
    patch.b = b;
    patch.manifold.normal = normal;
    for (int k = 0; k < 4; ++k) {
      const Corner& c = corners[static_cast<std::size_t>(k)];
      if (c.gap > reach_m) break;
      patch.manifold.points[patch.manifold.count++] = {c.at - (0.5F * c.gap) * normal, c.gap, c.feature};
    }
    patches.push_back(patch);
  }

  void meet_floor(std::uint32_t a, float reach_m) { meet(a, core::kFirstFace + 2, {0.0F, 1.0F, 0.0F}, {}, reach_m); }
  // The same, on the upper face of box b.
  void meet_top(std::uint32_t a, std::uint32_t b, float reach_m) {
    const core::Vec3 up = core::turned_axes(states[b].q).y;
    meet(a, b, up, states[b].x + half_sides_m[b].y * up, reach_m);
  }

  void step(ContactSolver& solver) {
    std::sort(patches.begin(), patches.end(), [](const core::ContactPatch& p, const core::ContactPatch& q) {
      return p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    solver.advance(states, patches, {masses, materials, {}, face_material, gravity_m_s2, dt_s});
  }
};

}  // namespace broadside::reference
