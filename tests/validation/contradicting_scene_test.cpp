// The frames are sound and the scene beside them is changed: some law must see that the frames belong to another scene.
#include <memory>
#include <utility>

#include "tests/validation/corruption.hpp"

namespace broadside::tests {
namespace {

core::Parameters& parameters(Recording& r) {
  return r.header.scene.parameters;
}

core::Body& body(Recording& r, std::size_t i) {
  return r.header.scene.bodies[i];
}

// All bodies take the changed mesh.
template <typename Change>
void change_mesh(Recording& r, Change change) {
  auto mesh = std::make_shared<core::Mesh>(*r.header.scene.meshes[0]);
  change(*mesh);
  r.header.scene.meshes[0] = std::move(mesh);
}

constexpr Corruption kForces[] = {
    {"gravity along another axis", "two-body:slide", "state-sanity",
     [](Recording& r) { std::swap(r.header.scene.gravity_m_s2.x, r.header.scene.gravity_m_s2.y); }},
    {"gravity a thousandth larger", "two-body:resting", "state-sanity",
     [](Recording& r) { r.header.scene.gravity_m_s2.y *= 1.001F; }},
    {"a step of half the length", "two-body:slide", "state-sanity",
     [](Recording& r) {
       r.header.scene.dt_s *= 0.5F;
       for (FrameRecord& frame : r.frames) frame.time_s *= 0.5;
     }},
    {"a spring taken away", "springs:hanging", "state-sanity",
     [](Recording& r) { r.header.scene.springs.erase(r.header.scene.springs.begin()); }},
    {"a spring given to a body of its own", "springs:hanging", "stability",
     [](Recording& r) {
       core::Spring more = r.header.scene.springs[0];
       more.anchor.y += 1.0F;
       r.header.scene.springs.push_back(more);
     }},
    {"a spring held a centimeter higher", "springs:hanging", "stability",
     [](Recording& r) { r.header.scene.springs[0].anchor.y += 0.01F; }},
    {"a damper a hundredth stronger", "springs:hanging", "stability",
     [](Recording& r) {
       for (core::Spring& s : r.header.scene.springs) s.damping_n_s_m *= 1.01F;
     }},
    {"two springs of unlike bodies exchanged", "springs:hanging", "stability",
     [](Recording& r) { std::swap(r.header.scene.springs.front().body, r.header.scene.springs.back().body); }},
};

TEST(Contradictions, OfForcesInTheScene) {
  expect_rejected(kForces);
}

constexpr Corruption kBodies[] = {
    {"a start 0.1 mm elsewhere", "two-body:apart", "state-sanity",
     [](Recording& r) { body(r, 0).position.z += 1e-4F; }},
    {"a start velocity that is a little faster", "balls", "state-sanity",
     [](Recording& r) { body(r, 0).velocity.x *= 1.0001F; }},
    {"a start velocity across", "two-body:slide", "state-sanity", [](Recording& r) { body(r, 0).velocity.z = 1e-3F; }},
    {"two starts exchanged", "two-body:apart", "state-sanity",
     [](Recording& r) { std::swap(body(r, 0).position, body(r, 1).position); }},
    {"a cube turned by a quarter", "two-body:apart", "state-sanity",
     [](Recording& r) {
       body(r, 0).orientation = {0.70710678F, 0.70710678F, 0.0F, 0.0F};
     }},
    {"a body more", "two-body:apart", "state-sanity",
     [](Recording& r) { r.header.scene.bodies.push_back(r.header.scene.bodies[0]); }},
    {"a body less", "two-body:apart", "state-sanity", [](Recording& r) { r.header.scene.bodies.pop_back(); }},
    {"a body in the air that is static", "mixed", "state-sanity", [](Recording& r) { body(r, 5).inverse_mass = 0.0F; }},
    {"a static block that could move", "mixed", "state-sanity", [](Recording& r) { body(r, 2).inverse_mass = 1.0F; }},
    {"a mass a thousandth larger", "two-body:unequal", "center-of-mass",
     [](Recording& r) { body(r, 0).inverse_mass /= 1.001F; }},
    {"two masses exchanged", "mixed", "center-of-mass",
     [](Recording& r) { std::swap(body(r, 0).inverse_mass, body(r, 1).inverse_mass); }},
    {"a mass at a wall a tenth larger", "two-body:slide", "normal-energy",
     [](Recording& r) { body(r, 0).inverse_mass /= 1.1F; }},
    {"a mesh a thousandth larger", "two-body:apart", "state-sanity",
     [](Recording& r) {
       change_mesh(r, [](core::Mesh& mesh) {
         for (Vec3& v : mesh.vertices) v = 1.001F * v;
       });
     }},
    {"a vertex that touches moved inward", "mixed", "proximity-bound",
     [](Recording& r) {
       const std::uint32_t vertex = bench::touch_of(r).proximity->vertex_a;
       change_mesh(r, [vertex](core::Mesh& mesh) { mesh.vertices[vertex] = 0.5F * mesh.vertices[vertex]; });
     }},
    {"vertices numbered the other way", "mixed", "proximity-bound",
     [](Recording& r) {
       change_mesh(r, [](core::Mesh& mesh) { std::reverse(mesh.vertices.begin(), mesh.vertices.end()); });
     }},
};

TEST(Contradictions, OfBodiesInTheScene) {
  expect_rejected(kBodies);
}

constexpr Corruption kSurfaces[] = {
    {"faces twice as slippery", "two-body:slide", "friction-energy",
     [](Recording& r) { r.header.scene.face_material.mu_kinetic *= 0.5F; }},
    {"faces without friction", "two-body:slide", "friction-energy",
     [](Recording& r) { r.header.scene.face_material.mu_kinetic = r.header.scene.face_material.mu_static = 0.0F; }},
    {"faces that throw back", "mixed", "restitution",
     [](Recording& r) { r.header.scene.face_material.restitution = 0.9F; }},
    {"one surface that throws back", "two-body:unequal", "restitution",
     [](Recording& r) { body(r, 1).material.restitution = 0.95F; }},
    {"one surface without friction", "two-body:oblique", "friction-energy",
     [](Recording& r) { body(r, 1).material.mu_kinetic = body(r, 1).material.mu_static = 0.0F; }},
    {"a floor a millimeter lower", "two-body:slide", "contact-normal",
     [](Recording& r) { r.header.scene.domain.min.y -= 1e-3F; }},
    {"a floor a millimeter higher", "two-body:slide", "contact-normal",
     [](Recording& r) { r.header.scene.domain.min.y += 1e-3F; }},
    {"a wall where bodies are", "mixed", "contact-set", [](Recording& r) { r.header.scene.domain.max.x = 6.0F; }},
    {"every bounce counts", "two-body:resting", "restitution",
     [](Recording& r) { parameters(r).v_threshold_m_s = 0.0F; }},
    {"twice the floor of impulses", "pile", "restitution", [](Recording& r) { parameters(r).impulse_min_n_s *= 2.0F; }},
    {"no slop", "mixed", "contraction", [](Recording& r) { parameters(r).delta_m = 0.0F; }},
    {"all of the depth corrected at once", "mixed", "contraction", [](Recording& r) { parameters(r).beta = 1.0F; }},
    {"no smoothing", "mixed", "contraction", [](Recording& r) { parameters(r).alpha = 1.0F; }},
    {"centers that count as one from farther away", "mixed", "contact-normal",
     [](Recording& r) { parameters(r).epsilon_m = 100.0F; }},
    {"vertices that touch from farther away", "balls", "proximity-bound",
     [](Recording& r) { parameters(r).theta_m *= 2.0F; }},
    {"a theta that no vertices reached", "balls", "proximity-bound",
     [](Recording& r) { parameters(r).theta_m *= 0.01F; }},
};

TEST(Contradictions, OfSurfacesAndParametersInTheScene) {
  expect_rejected(kSurfaces);
}

}  // namespace
}  // namespace broadside::tests
