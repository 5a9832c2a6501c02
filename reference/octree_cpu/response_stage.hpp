// Applies the collision response to all touching pairs and to the faces of the domain: METHOD sections 4 to 6.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/contact.hpp"
#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "core/parameters.hpp"
#include "core/variant.hpp"
#include "reference/octree_cpu/bodies.hpp"
#include "reference/octree_cpu/coloring.hpp"

namespace broadside::reference {

enum class Solver { kColored, kJacobi, kRacing };

struct ResponseRules {
  core::Parameters parameters;
  core::Variant variant = core::Variant::kSound;
  Solver solver = Solver::kColored;
  core::Box domain;
  core::Material face_material;
};

class ResponseStage {
 public:
  // touching: sorted pairs. Geometry is computed when a contact is applied, from the boxes at the positions that
  // earlier contacts left; a pair that no longer overlaps by then makes no contact.
  void resolve_bodies(Bodies& bodies, const ResponseRules& rules, std::span<const core::Pair> touching);
  // The six faces of the domain, body by body, then the velocity clamp P(23).
  void resolve_faces(Bodies& bodies, const ResponseRules& rules);

  // Everything applied since resolve_bodies, in the order of application: by color, by pair; then by body, by face.
  void collect(std::vector<core::Contact>& contacts) const;
  // The contacts' part of the frame's digest.
  [[nodiscard]] std::uint64_t digest() const;

 private:
  void apply(Bodies& bodies, const ResponseRules& rules, core::Pair pair, std::uint32_t color, core::Contact& contact);
  void resolve_jacobi(Bodies& bodies, const ResponseRules& rules, std::span<const core::Pair> touching);
  void resolve_racing(Bodies& bodies, const ResponseRules& rules, std::span<const core::Pair> touching);

  Coloring coloring_;
  // Slots in order of application; depth 0 marks a slot that made no contact.
  std::vector<core::Contact> contacts_;
  std::vector<std::array<core::Contact, core::kFaceCount>> face_contacts_;
  // Bit k of a body: its contact with face k was applied. Searching six contacts for each body would take longer.
  std::vector<std::uint8_t> touched_faces_;
  std::vector<core::Kinematics> sums_;
  std::vector<std::uint8_t> never_written_;
};

}  // namespace broadside::reference
