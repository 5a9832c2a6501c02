#include "bench/shrink/simpler_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "core/mesh/clean_mesh.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside::bench {
namespace {

using core::Scene;
using core::Vec3;

// Calls visit(float&) for each number whose digits may be removed, in a fixed order. Meshes are copied before they are
// changed.
template <typename Visit>
void visit_numbers(Scene& scene, Visit visit) {
  for (core::Body& b : scene.bodies)
    for (Vec3* v : {&b.position, &b.velocity})
      for (int k = 0; k < 3; ++k) visit((*v)[k]);
  for (auto& mesh : scene.meshes) {
    auto copy = std::make_shared<core::Mesh>(*mesh);
    for (Vec3& v : copy->vertices)
      for (int k = 0; k < 3; ++k) visit(v[k]);
    mesh = std::move(copy);
  }
  for (int k = 0; k < 3; ++k) visit(scene.domain.min[k]), visit(scene.domain.max[k]);
  for (core::Spring& s : scene.springs) {
    for (int k = 0; k < 3; ++k) visit(s.anchor[k]);
    visit(s.stiffness_n_m), visit(s.damping_n_s_m);
  }
}

double squared(Vec3 a, Vec3 b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += (double{a[k]} - b[k]) * (double{a[k]} - b[k]);
  return sum;
}

Scene with_mesh(const Scene& scene, std::size_t m, core::Mesh mesh) {
  Scene changed = scene;
  mesh.name = scene.meshes[m]->name;
  mesh.source = "made by broadside shrink";
  changed.meshes[m] = std::make_shared<const core::Mesh>(std::move(mesh));
  return changed;
}

// An upper bound on the coordinates, without sign, that a body and its mesh can reach in the scene's frames at the
// highest speed.
float far_enough(const Scene& scene) {
  double far = 1.0;
  for (const core::Body& b : scene.bodies)
    for (int k = 0; k < 3; ++k) far = std::max(far, std::abs(double{b.position[k]}));
  for (const auto& mesh : scene.meshes)
    for (const Vec3 v : mesh->vertices)
      for (int k = 0; k < 3; ++k) far = std::max(far, std::abs(double{v[k]}));
  for (const core::Spring& s : scene.springs)
    for (int k = 0; k < 3; ++k) far = std::max(far, std::abs(double{s.anchor[k]}));
  far += double{scene.parameters.v_max_m_s} * scene.dt_s * scene.frames;
  float power = 10.0F;
  while (power < 4.0 * far) power *= 10.0F;
  return power;
}

Scene at_origin(Scene scene) {
  if (scene.bodies.empty()) return scene;
  const Vec3 shift = scene.bodies.front().position;
  for (core::Body& b : scene.bodies) b.position = b.position - shift;
  for (core::Spring& s : scene.springs) s.anchor = s.anchor - shift;
  scene.domain.min = scene.domain.min - shift;
  scene.domain.max = scene.domain.max - shift;
  return scene;
}

}  // namespace

Scene with_bodies(const Scene& scene, std::span<const std::uint32_t> bodies) {
  std::vector<std::uint32_t> order(bodies.begin(), bodies.end());
  std::sort(order.begin(), order.end());
  Scene smaller = scene;
  smaller.bodies.clear();
  smaller.meshes.clear();
  smaller.springs.clear();
  smaller.wrenches.clear();
  smaller.mass_properties.clear();
  smaller.is_fast.clear();
  std::map<std::uint32_t, std::uint32_t> new_index;
  std::map<std::uint32_t, std::uint32_t> new_body;
  for (const std::uint32_t i : order) {
    new_body[i] = static_cast<std::uint32_t>(smaller.bodies.size());
    core::Body body = scene.bodies[i];
    const auto [at, is_new] = new_index.try_emplace(body.mesh, static_cast<std::uint32_t>(smaller.meshes.size()));
    if (is_new) smaller.meshes.push_back(scene.meshes[body.mesh]);
    body.mesh = at->second;
    smaller.bodies.push_back(body);
    if (!scene.mass_properties.empty()) smaller.mass_properties.push_back(scene.mass_properties[i]);
    if (!scene.is_fast.empty()) smaller.is_fast.push_back(scene.is_fast[i]);
  }
  for (core::Spring spring : scene.springs) {
    const auto at = new_body.find(spring.body);
    if (at == new_body.end()) continue;
    spring.body = at->second;
    smaller.springs.push_back(spring);
  }
  for (core::Wrench wrench : scene.wrenches) {
    const auto at = new_body.find(wrench.body);
    if (at == new_body.end()) continue;
    wrench.body = at->second;
    smaller.wrenches.push_back(wrench);
  }
  return smaller;
}

Scene with_springs(const Scene& scene, std::span<const std::uint32_t> springs) {
  Scene fewer = scene;
  fewer.springs.clear();
  for (const std::uint32_t s : springs) fewer.springs.push_back(scene.springs[s]);
  return fewer;
}

std::vector<std::uint32_t> by_distance(const Scene& scene, std::span<const std::uint32_t> from) {
  std::vector<double> distance(scene.bodies.size(), 0.0);
  for (std::size_t i = 0; i < scene.bodies.size() && !from.empty(); ++i) {
    distance[i] = std::numeric_limits<double>::infinity();
    for (const std::uint32_t f : from)
      distance[i] = f == i ? -1.0 : std::min(distance[i], squared(scene.bodies[i].position, scene.bodies[f].position));
    if (std::find(from.begin(), from.end(), i) != from.end()) distance[i] = -1.0;
  }
  std::vector<std::uint32_t> order(scene.bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto p, auto q) { return distance[p] < distance[q]; });
  return order;
}

std::optional<Scene> with_box_mesh(const Scene& scene, std::size_t m) {
  constexpr std::size_t kBoxTriangles = 12;
  if (scene.meshes[m]->triangles.size() <= kBoxTriangles) return std::nullopt;
  const core::Box box = core::bounds(*scene.meshes[m]);
  const Vec3 size = box.max - box.min;
  auto made = datasets::box_mesh({size.x, size.y, size.z}, {1, 1, 1});
  if (!made) return std::nullopt;
  core::Mesh mesh = std::move(made).value();
  for (Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] = v[k] > 0.0F ? box.max[k] : box.min[k];
  return with_mesh(scene, m, std::move(mesh));
}

std::optional<Scene> with_triangles(const Scene& scene, std::size_t m, std::span<const std::uint32_t> triangles) {
  core::Mesh mesh = *scene.meshes[m];
  mesh.triangles.clear();
  for (const std::uint32_t t : triangles) mesh.triangles.push_back(scene.meshes[m]->triangles[t]);
  core::clean_mesh(mesh);
  if (mesh.triangles.empty()) return std::nullopt;
  return with_mesh(scene, m, std::move(mesh));
}

Scene made_plainer(const Scene& scene, Plainer how) {
  Scene plain = scene;
  switch (how) {
    case Plainer::kNoGravity:
      plain.gravity_m_s2 = {};
      break;
    case Plainer::kWideDomain: {
      const float far = far_enough(scene);
      plain.domain = {{-far, -far, -far}, {far, far, far}};
      break;
    }
    case Plainer::kOneMaterial:
      for (core::Body& b : plain.bodies) b.material = {};
      plain.face_material = {};
      break;
    case Plainer::kDefaultParameters:
      plain.parameters = {};
      break;
    case Plainer::kUnitMass:
      for (core::Body& b : plain.bodies)
        if (b.inverse_mass > 0.0F) b.inverse_mass = 1.0F;
      break;
    case Plainer::kNoTurn:
      for (core::Body& b : plain.bodies) b.orientation = {}, b.angular_velocity = {};
      break;
    case Plainer::kAtOrigin:
      return at_origin(std::move(plain));
    case Plainer::kNoDescription:
      plain.seed = 0;
      break;
  }
  return plain;
}

float rounded_to(float value, int digits) {
  if (digits <= 0) return 0.0F;
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, double{value});
  return std::strtof(text, nullptr);
}

std::uint64_t digit_count(const Scene& scene) {
  std::uint64_t count = 6 * scene.bodies.size() + 6 + 5 * scene.springs.size();
  for (const auto& mesh : scene.meshes) count += 3 * mesh->vertices.size();
  return count;
}

Scene with_digits(const Scene& scene, std::uint64_t k, int digits) {
  Scene plain = scene;
  std::uint64_t at = 0;
  visit_numbers(plain, [&](float& value) {
    if (at++ == k) value = rounded_to(value, digits);
  });
  return plain;
}

Scene with_digits_everywhere(const Scene& scene, int digits) {
  Scene plain = scene;
  visit_numbers(plain, [digits](float& value) { value = rounded_to(value, digits); });
  return plain;
}

}  // namespace broadside::bench
