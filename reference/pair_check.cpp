#include "reference/pair_check.hpp"

#include <algorithm>
#include <string>

#include "core/scene/primitive.hpp"

namespace broadside::reference {

core::Status check_pairs(std::string_view engine, std::span<const core::Pair> pairs, std::span<const core::Pose> poses,
                         std::size_t body_count) {
  const std::string where = std::string(engine) + ": measure";
  if (poses.size() != body_count) {
    return core::Error{std::to_string(poses.size()) + " poses for " + std::to_string(body_count) + " bodies", where,
                       "give one pose per body of the loaded scene", core::Exit::kInternal};
  }
  const auto bad =
      std::find_if(pairs.begin(), pairs.end(), [&](core::Pair p) { return p.i >= p.j || p.j >= body_count; });
  if (bad != pairs.end()) {
    return core::Error{"(" + std::to_string(bad->i) + ", " + std::to_string(bad->j) + ") is no pair of these bodies",
                       where, "give i < j < the number of bodies", core::Exit::kInternal};
  }
  return core::Done{};
}

core::Status refuse_cylinder(std::string_view engine, const core::Mesh& mesh) {
  const auto primitive = core::primitive_of(mesh);
  if (!primitive || primitive->kind != core::PrimitiveKind::kCylinder) return core::Done{};
  return core::Error{"unsupported: cylinder, the shape of mesh '" + mesh.name + "'", std::string(engine) + ": load",
                     "measure it with fcl-shapes or bullet-shapes", core::Exit::kMissing};
}

core::Error no_shape(std::string_view engine, const core::Mesh& mesh) {
  return {"mesh '" + mesh.name + "' is no box, sphere, capsule or convex body", std::string(engine) + ": load",
          "measure it with fcl-mesh or exact-mesh", core::Exit::kMissing};
}

}  // namespace broadside::reference
