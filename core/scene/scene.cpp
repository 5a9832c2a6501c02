#include "core/scene/scene.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "core/contact.hpp"

namespace broadside::core {
namespace {

bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Error bad(const Scene& scene, const std::string& where, const std::string& what, const std::string& advice) {
  return {what, scene.name + ": " + where, advice, Exit::kBadInput};
}

Status check_material(const Scene& scene, const std::string& where, const Material& m) {
  if (!(std::isfinite(m.mu_static) && m.mu_static >= 0.0F && std::isfinite(m.mu_kinetic) && m.mu_kinetic >= 0.0F))
    return bad(scene, where, "friction is negative or not finite", "give mu_static and mu_kinetic of 0 or more");
  if (m.mu_kinetic > m.mu_static)
    return bad(scene, where, "mu_kinetic is above mu_static", "give mu_kinetic <= mu_static");
  if (!(m.restitution >= 0.0F && m.restitution <= 1.0F))
    return bad(scene, where, "restitution is outside 0 to 1", "give 0 <= restitution <= 1");
  return Done{};
}

Status check_body(const Scene& scene, std::size_t index) {
  const Body& b = scene.bodies[index];
  const std::string where = "body " + std::to_string(index);
  if (b.mesh >= scene.meshes.size()) return bad(scene, where, "its mesh does not exist", "name a mesh of this scene");
  if (!is_finite(b.position))
    return bad(scene, where, "position is NaN or infinite", "give three finite numbers, in m");
  if (!is_finite(b.velocity))
    return bad(scene, where, "velocity is NaN or infinite", "give three finite numbers, in m/s");
  if (!is_finite(b.angular_velocity))
    return bad(scene, where, "angular_velocity is NaN or infinite", "give three finite numbers, in rad/s");
  const Quat q = b.orientation;
  const double norm2 = double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z;
  // A unit quaternion rounded to float has four components off by half an ulp each: |norm^2 - 1| <= 4 * 2^-24.
  if (!(std::abs(norm2 - 1.0) <= 4.0 * 0x1p-24))
    return bad(scene, where, "orientation is not a unit quaternion", "normalize w x y z");
  if (!(std::isfinite(b.inverse_mass) && b.inverse_mass >= 0.0F))
    return bad(scene, where, "mass is zero, negative or not finite", "give a mass above zero in kg, or static = true");
  return check_material(scene, where, b.material);
}

Status check_parameters(const Scene& scene) {
  const Parameters& p = scene.parameters;
  const auto in = [](float v, float low, float high) { return v >= low && v <= high; };
  constexpr float kMax = 3.4e38F;
  if (!in(p.delta_m, 0.0F, kMax)) return bad(scene, "parameters", "delta_m is out of range", "give 0 or more, in m");
  if (!(p.beta > 0.0F && p.beta <= 1.0F)) return bad(scene, "parameters", "beta is out of range", "give 0 < beta <= 1");
  if (!(p.alpha > 0.0F && p.alpha <= 1.0F))
    return bad(scene, "parameters", "alpha is out of range", "give 0 < alpha <= 1");
  if (!in(p.v_threshold_m_s, 0.0F, kMax))
    return bad(scene, "parameters", "v_threshold_m_s is out of range", "give 0 or more, in m/s");
  if (!in(p.impulse_min_n_s, 0.0F, kMax))
    return bad(scene, "parameters", "impulse_min_n_s is out of range", "give 0 or more, in N s");
  if (!(p.v_max_m_s > 0.0F && p.v_max_m_s <= kMax))
    return bad(scene, "parameters", "v_max_m_s is out of range", "give a speed above 0, in m/s");
  if (!in(p.epsilon_m, 0.0F, kMax))
    return bad(scene, "parameters", "epsilon_m is out of range", "give 0 or more, in m");
  if (!in(p.theta_m, 0.0F, kMax))
    return bad(scene, "parameters", "theta_m is out of range", "give 0 (mean edge length) or more, in m");
  if (!(p.hash_cell_m > 0.0F && p.hash_cell_m <= kMax))
    return bad(scene, "parameters", "hash_cell_m is out of range", "give a length above 0, in m");
  return Done{};
}

Status check_mesh(const Scene& scene, const Mesh& mesh) {
  const std::string where = "mesh " + mesh.name;
  if (mesh.vertices.empty() || mesh.triangles.empty())
    return bad(scene, where, "it has no triangles", "use a mesh with at least one triangle");
  for (const Vec3 v : mesh.vertices)
    if (!is_finite(v)) return bad(scene, where, "a vertex is NaN or infinite", "repair the mesh file");
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.vertices.size())
        return bad(scene, where, "a triangle names a vertex that does not exist", "repair the mesh file");
  return Done{};
}

Status check_spring(const Scene& scene, std::size_t index) {
  const Spring& s = scene.springs[index];
  const std::string where = "spring " + std::to_string(index);
  const auto is_least_zero = [](float v) { return std::isfinite(v) && v >= 0.0F; };
  if (s.body >= scene.bodies.size()) return bad(scene, where, "its body does not exist", "name a body of this scene");
  if (!(scene.bodies[s.body].inverse_mass > 0.0F))
    return bad(scene, where, "its body is static", "name a body that can move");
  if (!is_finite(s.anchor)) return bad(scene, where, "anchor is NaN or infinite", "give three finite numbers, in m");
  if (!is_least_zero(s.stiffness_n_m))
    return bad(scene, where, "stiffness is negative or not finite", "give 0 or more, in N/m");
  if (!is_least_zero(s.damping_n_s_m))
    return bad(scene, where, "damping is negative or not finite", "give 0 or more, in N s/m");
  return Done{};
}

Status check_wrench(const Scene& scene, std::size_t index) {
  const Wrench& w = scene.wrenches[index];
  const std::string where = "wrench " + std::to_string(index);
  if (w.body >= scene.bodies.size()) return bad(scene, where, "its body does not exist", "name a body of this scene");
  if (!(scene.bodies[w.body].inverse_mass > 0.0F))
    return bad(scene, where, "its body is static", "name a body that can move");
  if (w.axes != WrenchAxes::kWorld && w.axes != WrenchAxes::kBody)
    return bad(scene, where, "its axes are neither the world's nor the body's", "give 0 = world or 1 = body");
  if (!is_finite(w.force_n)) return bad(scene, where, "force is NaN or infinite", "give three finite numbers, in N");
  if (!is_finite(w.torque_n_m))
    return bad(scene, where, "torque is NaN or infinite", "give three finite numbers, in N m");
  if (scene.motion == Motion::kTranslate && !(w.torque_n_m == Vec3{}))
    return bad(scene, where, "it has a torque, and the scene's bodies translate only", "give motion = \"rigid\"");
  return Done{};
}

Status check_fast(const Scene& scene) {
  if (scene.is_fast.empty() || scene.is_fast.size() == scene.bodies.size()) return Done{};
  return bad(scene, "bodies", "some bodies say whether they are fast and some do not", "say it of every body");
}

Status check_motion(const Scene& scene) {
  if (scene.motion == Motion::kTranslate && scene.mass_properties.empty()) return Done{};
  if (!scene.mass_properties.empty() && scene.mass_properties.size() != scene.bodies.size())
    return bad(scene, "bodies", "some bodies have mass properties and some have none", "give them for every body");
  if (scene.motion == Motion::kRigid && !scene.springs.empty())
    return bad(scene, "springs", "springs work only on bodies that translate",
               "leave out springs, or motion = \"rigid\"");
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    if (!(scene.bodies[i].inverse_mass > 0.0F)) continue;
    if (scene.mass_properties.empty()) continue;
    if (const Status s = check_mass_properties(scene.mass_properties[i]); !s)
      return bad(scene, "body " + std::to_string(i), s.error().what, s.error().advice);
  }
  // Bodies with one mesh and mass have one inertia, so each mesh is tried once.
  if (scene.motion == Motion::kTranslate || !scene.mass_properties.empty()) return Done{};
  std::vector<std::uint8_t> is_tried(scene.meshes.size());
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    const Body& b = scene.bodies[i];
    if (!(b.inverse_mass > 0.0F) || is_tried[b.mesh]++ != 0) continue;
    if (const auto derived = mass_properties_of(scene, i); !derived) return derived.error();
  }
  return Done{};
}

class CanonicalHash {
 public:
  CanonicalHash() : state_(XXH64_createState()) { XXH64_reset(state_, 0); }
  ~CanonicalHash() { XXH64_freeState(state_); }
  CanonicalHash(const CanonicalHash&) = delete;
  CanonicalHash& operator=(const CanonicalHash&) = delete;

  template <typename T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    XXH64_update(state_, &value, sizeof value);
  }
  void add(const Material& m) { add(m.mu_static), add(m.mu_kinetic), add(m.restitution); }
  [[nodiscard]] std::uint64_t value() const { return XXH64_digest(state_); }

 private:
  XXH64_state_t* state_;
};

}  // namespace

Status check_scene(const Scene& scene) {
  for (const auto& mesh : scene.meshes)
    if (Status s = check_mesh(scene, *mesh); !s) return s;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (Status s = check_body(scene, i); !s) return s;
  if (scene.bodies.size() >= kFirstFace)
    return bad(scene, "bodies", "too many bodies", "the ids from 0xFFFFFFF0 are faces of the domain");
  for (std::size_t i = 0; i < scene.springs.size(); ++i)
    if (Status s = check_spring(scene, i); !s) return s;
  for (std::size_t i = 0; i < scene.wrenches.size(); ++i)
    if (Status s = check_wrench(scene, i); !s) return s;
  if (Status s = check_material(scene, "faces", scene.face_material); !s) return s;
  if (!is_finite(scene.gravity_m_s2))
    return bad(scene, "gravity_m_s2", "it is NaN or infinite", "give three finite numbers, in m/s^2");
  if (!(scene.dt_s > 0.0F && std::isfinite(scene.dt_s)))
    return bad(scene, "dt_s", "it is zero, negative or not finite", "give a step above zero, in s");
  if (Status s = check_motion(scene); !s) return s;
  if (Status s = check_fast(scene); !s) return s;
  const Box& d = scene.domain;
  if (!(is_finite(d.min) && is_finite(d.max) && d.min.x < d.max.x && d.min.y < d.max.y && d.min.z < d.max.z))
    return bad(scene, "domain", "it has no volume or is not finite", "give min below max on every axis, in m");
  return check_parameters(scene);
}

std::string_view motion_word(Motion motion) {
  return motion == Motion::kRigid ? "rigid" : "translate";
}

Result<MassProperties> mass_properties_of(const Scene& scene, std::uint32_t body) {
  if (!scene.mass_properties.empty()) return scene.mass_properties[body];
  const Body& b = scene.bodies[body];
  auto derived = uniform_mass_properties(*scene.meshes[b.mesh], 1.0 / static_cast<double>(b.inverse_mass));
  if (derived) return derived;
  return bad(scene, "body " + std::to_string(body), derived.error().what, derived.error().advice);
}

Result<std::vector<MassProperties>> all_mass_properties(const Scene& scene) {
  std::vector<MassProperties> all(scene.bodies.size());
  std::map<std::pair<std::uint32_t, float>, MassProperties> known;  // by mesh and inverse mass
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    const Body& b = scene.bodies[i];
    if (!(b.inverse_mass > 0.0F)) continue;
    if (!scene.mass_properties.empty()) {
      all[i] = scene.mass_properties[i];
      continue;
    }
    auto at = known.find({b.mesh, b.inverse_mass});
    if (at == known.end()) {
      const auto made = mass_properties_of(scene, i);
      if (!made) return made.error();
      at = known.emplace(std::pair{b.mesh, b.inverse_mass}, made.value()).first;
    }
    all[i] = at->second;
  }
  return all;
}

std::vector<std::string> hull_notes(const Scene& scene) {
  std::vector<std::string> notes;
  if (scene.motion == Motion::kTranslate || !scene.mass_properties.empty()) return notes;
  std::vector<std::uint8_t> is_seen(scene.meshes.size());
  for (const Body& b : scene.bodies) {
    if (!(b.inverse_mass > 0.0F) || is_seen[b.mesh]++ != 0) continue;
    const auto solid = uniform_solid(*scene.meshes[b.mesh], 1.0);
    if (solid && solid.value().solid == Solid::kHull)
      notes.push_back("inertia of mesh " + scene.meshes[b.mesh]->name +
                      " is its convex hull's: " + solid.value().why_hull);
  }
  return notes;
}

std::uint64_t scene_digest(const Scene& scene) {
  static_assert(std::endian::native == std::endian::little, "canonical bytes are little-endian");
  CanonicalHash hash;
  hash.add(std::uint64_t{1});  // version of this byte layout
  hash.add(std::uint64_t{scene.meshes.size()});
  for (const auto& mesh : scene.meshes) {
    hash.add(std::uint64_t{mesh->vertices.size()});
    for (const Vec3 v : mesh->vertices) hash.add(v);
    hash.add(std::uint64_t{mesh->triangles.size()});
    for (const Triangle& t : mesh->triangles) hash.add(t);
  }
  hash.add(std::uint64_t{scene.bodies.size()});
  for (const Body& b : scene.bodies) {
    hash.add(b.mesh), hash.add(b.position), hash.add(b.orientation), hash.add(b.velocity);
    hash.add(b.angular_velocity), hash.add(b.inverse_mass), hash.add(b.material);
  }
  hash.add(scene.domain), hash.add(scene.face_material), hash.add(scene.gravity_m_s2), hash.add(scene.dt_s);
  hash.add(scene.frames), hash.add(scene.seed), hash.add(scene.parameters);
  // Added only where there are springs: the digests of scenes without springs are older than springs.
  for (const Spring& s : scene.springs) hash.add(s);
  // Likewise, scenes whose bodies translate keep the digests that they had before bodies could turn.
  if (scene.motion != Motion::kTranslate || !scene.mass_properties.empty()) {
    hash.add(scene.motion);
    for (const MassProperties& p : scene.mass_properties) hash.add(p.center_of_mass_m), hash.add(p.inertia_kg_m2);
  }
  // The same holds for scenes without wrenches. The word in front distinguishes their bytes from those of springs.
  if (!scene.wrenches.empty()) hash.add(std::array<char, 8>{'w', 'r', 'e', 'n', 'c', 'h', 'e', 's'});
  for (const Wrench& w : scene.wrenches) hash.add(w);
  // The same holds for scenes in which no body is flagged as fast.
  if (std::find(scene.is_fast.begin(), scene.is_fast.end(), 1) != scene.is_fast.end()) {
    hash.add(std::array<char, 8>{'f', 'a', 's', 't', 'b', 'o', 'd', 'y'});
    for (const std::uint8_t is_fast : scene.is_fast) hash.add(is_fast);
  }
  return hash.value();
}

}  // namespace broadside::core
