#include "core/mesh/clean_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

struct PositionHash {
  std::size_t operator()(const Vec3& v) const {
    // + 0 turns -0 into +0: the two compare equal, so they must have the same hash.
    const auto word = [](float f) { return std::uint64_t{std::bit_cast<std::uint32_t>(f + 0.0F)}; };
    std::uint64_t h = word(v.x) * 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 29) ^ word(v.y)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 31) ^ word(v.z)) * 0x94d049bb133111ebULL;
    return h ^ (h >> 30);
  }
};

std::uint64_t merge_repeated(Mesh& mesh) {
  std::unordered_map<Vec3, std::uint32_t, PositionHash> first;
  first.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> kept(mesh.vertices.size());
  std::uint64_t repeated = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto [entry, is_new] = first.try_emplace(mesh.vertices[v], v);
    kept[v] = entry->second;
    repeated += is_new ? 0 : 1;
  }
  if (repeated > 0)
    for (Triangle& t : mesh.triangles)
      for (std::uint32_t& v : t) v = kept[v];
  return repeated;
}

bool has_area(const Mesh& mesh, const Triangle& t) {
  std::array<double, 3> p;
  std::array<double, 3> q;
  for (int k = 0; k < 3; ++k) {
    p[k] = double{mesh.vertices[t[1]][k]} - double{mesh.vertices[t[0]][k]};
    q[k] = double{mesh.vertices[t[2]][k]} - double{mesh.vertices[t[0]][k]};
  }
  return p[1] * q[2] != p[2] * q[1] || p[2] * q[0] != p[0] * q[2] || p[0] * q[1] != p[1] * q[0];
}

std::uint64_t drop_unreferenced(Mesh& mesh) {
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kNone);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) renumbered[v] = 0;
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (renumbered[v] == kNone) continue;
    mesh.vertices[next] = mesh.vertices[v];
    renumbered[v] = next++;
  }
  const std::uint64_t dropped = mesh.vertices.size() - next;
  mesh.vertices.resize(next);
  if (dropped > 0)
    for (Triangle& t : mesh.triangles)
      for (std::uint32_t& v : t) v = renumbered[v];
  return dropped;
}

}  // namespace

std::string Dropped::text() const {
  std::string text;
  const auto part = [&](std::uint64_t count, const char* one, const char* many) {
    if (count == 0) return;
    if (!text.empty()) text += ", ";
    text += std::to_string(count) + (count == 1 ? one : many);
  };
  part(repeated_vertices, " repeated vertex", " repeated vertices");
  part(collapsed_triangles, " triangle with a repeated corner", " triangles with a repeated corner");
  part(zero_area_triangles, " triangle without area", " triangles without area");
  part(unreferenced_vertices, " unreferenced vertex", " unreferenced vertices");
  return text.empty() ? "nothing" : text;
}

Dropped clean_mesh(Mesh& mesh) {
  Dropped dropped;
  dropped.repeated_vertices = merge_repeated(mesh);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return ++dropped.collapsed_triangles, true;
    if (!has_area(mesh, t)) return ++dropped.zero_area_triangles, true;
    return false;
  });
  // A merged vertex is unreferenced too, but was already counted as repeated.
  dropped.unreferenced_vertices = drop_unreferenced(mesh) - dropped.repeated_vertices;
  return dropped;
}

Mesh normalized(Mesh mesh, double longest_side_m) {
  const Box box = bounds(mesh);
  std::array<double, 3> middle;
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    middle[k] = 0.5 * (double{box.min[k]} + double{box.max[k]});
    longest = std::max(longest, double{box.max[k]} - double{box.min[k]});
  }
  const double scale = longest_side_m / longest;
  for (Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] = static_cast<float>((double{v[k]} - middle[k]) * scale);
  return mesh;
}

}  // namespace broadside::core
