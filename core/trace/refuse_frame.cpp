#include "core/trace/refuse_frame.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace broadside::core {
namespace {

bool is_bad(Pair p, std::uint32_t bodies) {
  return p.i >= bodies || p.j >= bodies;
}

bool any_bad(const std::vector<Pair>& pairs, std::uint32_t bodies) {
  return std::any_of(pairs.begin(), pairs.end(), [bodies](Pair p) { return is_bad(p, bodies); });
}

// For contacts and points alike.
template <typename Row>
bool is_bad(const Row& c, std::uint32_t bodies) {
  const bool is_known_face = is_face(c.b) && c.b - kFirstFace < kFaceCount;
  return c.a >= bodies || (c.b >= bodies && !is_known_face);
}

// The dataset with a body id that the scene does not have; "" when there is none.
const char* bad_body(const FrameRecord& r, std::uint32_t bodies) {
  if (any_bad(r.pairs, bodies)) return "/trace/pairs/pairs";
  if (any_bad(r.confirmed, bodies)) return "/trace/confirmed/pairs";
  if (any_bad(r.measured, bodies)) return "/trace/narrow/pairs";
  const auto bad = [bodies](const auto& c) { return is_bad(c, bodies); };
  if (std::any_of(r.points.begin(), r.points.end(), bad)) return "/trace/point";
  return std::any_of(r.contacts.begin(), r.contacts.end(), bad) ? "/trace/contact" : "";
}

// Called after bad_body: the bodies of the confirmed pairs exist.
bool any_bad_vertex(const FrameRecord& r, const Scene& scene) {
  const auto vertices = [&scene](std::uint32_t body) { return scene.meshes[scene.bodies[body].mesh]->vertices.size(); };
  for (std::size_t k = 0; k < r.proximity.size(); ++k) {
    const Proximity& p = r.proximity[k];
    if (!p.is_touching()) continue;
    if (p.vertex_a >= vertices(r.confirmed[k].i) || p.vertex_b >= vertices(r.confirmed[k].j)) return true;
  }
  return false;
}

}  // namespace

std::optional<FrameFault> fault_of(const FrameRecord& frame, const Scene& scene) {
  const std::string step = "step " + std::to_string(frame.step);
  if (const char* at = bad_body(frame, scene.body_count()); *at != '\0')
    return FrameFault{at, step + " names a body that the scene does not have", "ids count from 0 in /scene/body"};
  if (any_bad_vertex(frame, scene))
    return FrameFault{"/trace/confirmed", step + " names a vertex that its mesh does not have",
                      "vertex ids count from 0 in each body's mesh"};
  return std::nullopt;
}

}  // namespace broadside::core
