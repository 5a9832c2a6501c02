#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reference/mutants/mutants.hpp"

namespace broadside::reference {
namespace {

using core::Contact;
using core::ContactGeometry;
using core::Pair;
using core::Parameters;
using core::Vec3;

core::Box box_now(const World& w, std::uint32_t body) {
  return core::translated(w.bodies.local_box(body), w.bodies.state[body].x);
}

// The overlaps of the pair's boxes on the three axes.
std::array<float, 3> overlaps_of(const World& w, Pair p) {
  const core::Box a = box_now(w, p.i);
  const core::Box b = box_now(w, p.j);
  std::array<float, 3> depth;
  for (int k = 0; k < 3; ++k) depth[k] = std::min(a.max[k], b.max[k]) - std::max(a.min[k], b.min[k]);
  return depth;
}

ContactGeometry along(const World& w, Pair p, const ContactGeometry& sound, int axis) {
  ContactGeometry g = sound;
  g.axis = axis;
  g.depth_m = overlaps_of(w, p)[axis];
  const bool is_below = core::center(box_now(w, p.i))[axis] < core::center(box_now(w, p.j))[axis];
  g.normal = core::axis_vector(axis, is_below ? -1.0F : 1.0F);
  return g;
}

// The sound response, with each body's displacement multiplied by its factor.
void moved(Contact& c, float factor_a, float factor_b) {
  c.post_a.x = c.pre_a.x + factor_a * (c.post_a.x - c.pre_a.x);
  c.post_b.x = c.pre_b.x + factor_b * (c.post_b.x - c.pre_b.x);
}

std::span<const Mutant> contact_table() {
  static const auto kTable = std::to_array<Mutant>({
      {"loses-a-contact",
       "the last pair of a frame that touches has no contact",
       "contact-set",
       "mixed",
       {.order =
            [](const World&, Order& order) {
              if (order.pairs.empty()) return;
              order.pairs.pop_back();
              order.color.pop_back();
            }}},
      {"skips-faces-in-the-slop",
       "a body that is inside the slop of a face has no contact with it",
       "contact-set",
       "mixed",
       {.face_geometry =
            [](const World& w, std::uint32_t, int, const ContactGeometry& sound) {
              ContactGeometry g = sound;
              g.exists = g.exists && g.depth_m > w.scene->parameters.delta_m;
              return g;
            }}},
      {"normal-from-a-to-b",
       "the normal points from A to B",
       "contact-normal",
       "mixed",
       {.store = [](const World&, Contact& c) { c.normal = -1.0F * c.normal; }}},
      {"pushes-inward",
       "the sign of the centers' difference is turned",
       "contact-normal",
       "mixed",
       {.geometry =
            [](const World&, Pair, const ContactGeometry& sound) {
              ContactGeometry g = sound;
              g.normal = -1.0F * g.normal;
              return g;
            }}},
      {"takes-largest-overlap",
       "the axis of largest overlap is taken",
       "contact-normal",
       "mixed",
       {.geometry =
            [](const World& w, Pair p, const ContactGeometry& sound) {
              const auto depth = overlaps_of(w, p);
              const auto axis = std::max_element(depth.begin(), depth.end()) - depth.begin();
              return sound.exists ? along(w, p, sound, static_cast<int>(axis)) : sound;
            }}},
      {"ties-take-highest-axis",
       "equal overlaps take the highest axis",
       "contact-normal",
       "ties",
       {.geometry =
            [](const World& w, Pair p, const ContactGeometry& sound) {
              if (!sound.exists) return sound;
              const auto depth = overlaps_of(w, p);
              int axis = 0;
              for (int k = 1; k < 3; ++k)
                if (depth[k] <= depth[axis]) axis = k;
              return along(w, p, sound, axis);
            }}},
      {"fudges-the-axis",
       "another axis wins only when it is 5 % less",
       "contact-normal",
       "fudge",
       {.geometry =
            [](const World& w, Pair p, const ContactGeometry& sound) {
              if (!sound.exists) return sound;
              const auto depth = overlaps_of(w, p);
              int axis = 0;
              for (int k = 1; k < 3; ++k)
                if (1.05F * depth[k] < depth[axis]) axis = k;
              return along(w, p, sound, axis);
            }}},
      {"normal-of-centers",
       "the normal is the direction between the centers",
       "contact-normal",
       "mixed",
       {.geometry =
            [](const World& w, Pair p, const ContactGeometry& sound) {
              ContactGeometry g = sound;
              const Vec3 between = core::center(box_now(w, p.i)) - core::center(box_now(w, p.j));
              if (core::length(between) > 0.0F) g.normal = (1.0F / core::length(between)) * between;
              return g;
            }}},
      {"normal-not-unit",
       "the normal is a thousandth too long",
       "contact-normal",
       "mixed",
       {.store = [](const World&, Contact& c) { c.normal = 1.001F * c.normal; }}},
      {"halves-the-depth",
       "half of the overlap is taken for the depth",
       "contact-normal",
       "mixed",
       {.geometry =
            [](const World&, Pair, const ContactGeometry& sound) {
              ContactGeometry g = sound;
              g.depth_m *= 0.5F;
              return g;
            }}},
      {"geometry-of-frame-start",
       "contacts use the boxes of detection, whatever earlier contacts moved",
       "contact-normal",
       "pile",
       {.geometry =
            [](const World& w, Pair p, const ContactGeometry&) {
              return core::box_contact(w.bodies.boxes[p.i], w.bodies.boxes[p.j], w.scene->parameters.epsilon_m);
            }}},
      {"faces-point-outward",
       "the normal of a face points out of the domain",
       "contact-normal",
       "mixed",
       {.face_geometry =
            [](const World&, std::uint32_t, int, const ContactGeometry& sound) {
              ContactGeometry g = sound;
              g.normal = -1.0F * g.normal;
              return g;
            }}},
      {"face-depth-of-center",
       "a body touches a face only when its center does",
       "state-sanity",
       "mixed",
       {.face_geometry =
            [](const World& w, std::uint32_t body, int face, const ContactGeometry&) {
              const Vec3 x = w.bodies.state[body].x;
              return core::face_contact({x, x}, w.scene->domain, face);
            }}},
      {"faces-before-pairs", "faces are resolved before pairs", "contact-normal", "pile", {.faces_first = true}},
      {"ignores-colors",
       "pairs are resolved by id, and called one color",
       "contact-normal",
       "pile",
       {.order =
            [](const World&, Order& order) {
              std::sort(order.pairs.begin(), order.pairs.end());
              std::fill(order.color.begin(), order.color.end(), 0U);
            }}},
      {"applies-beta-twice",
       "beta is applied twice",
       "contraction",
       "mixed",
       {.respond = [](const World&, const Application& a) { a.apply_with([](Parameters& q) { q.beta *= q.beta; }); }}},
      {"forgets-alpha",
       "the smoothing is left out",
       "contraction",
       "mixed",
       {.respond = [](const World&, const Application& a) { a.apply_with([](Parameters& q) { q.alpha = 1.0F; }); }}},
      {"forgets-the-slop",
       "the whole depth is corrected, not that above the slop",
       "contraction",
       "mixed",
       {.respond = [](const World&, const Application& a) { a.apply_with([](Parameters& q) { q.delta_m = 0.0F; }); }}},
      {"adds-the-slop",
       "the slop is added to the depth",
       "contraction",
       "mixed",
       {.respond = [](const World&,
                      const Application& a) { a.apply_with([](Parameters& q) { q.delta_m = -q.delta_m; }); }}},
      {"pulls-together",
       "the correction has the wrong sign",
       "contraction",
       "mixed",
       {.store = [](const World&, Contact& c) { moved(c, -1.0F, -1.0F); }}},
      {"never-corrects",
       "positions are not corrected",
       "contraction",
       "mixed",
       {.store = [](const World&, Contact& c) { moved(c, 0.0F, 0.0F); }}},
      {"shares-by-halves",
       "both bodies take half of the correction",
       "center-of-mass",
       "errata:E3",
       {.store =
            [](const World& w, Contact& c) {
              if (core::is_face(c.b) || w.bodies.is_static[c.a] != 0 || w.bodies.is_static[c.b] != 0) return;
              const Vec3 apart = (c.post_a.x - c.pre_a.x) - (c.post_b.x - c.pre_b.x);
              c.post_a.x = c.pre_a.x + 0.5F * apart;
              c.post_b.x = c.pre_b.x - 0.5F * apart;
            }}},
      {"moves-one-body",
       "only A is corrected, by the whole correction",
       "center-of-mass",
       "errata:E3",
       {.store =
            [](const World& w, Contact& c) {
              if (core::is_face(c.b) || w.bodies.is_static[c.a] != 0) return;
              c.post_a.x = c.post_a.x - (c.post_b.x - c.pre_b.x);
              c.post_b.x = c.pre_b.x;
            }}},
      {"pushes-one-body",
       "the impulse acts on A alone",
       "center-of-mass",
       "mixed",
       {.store =
            [](const World&, Contact& c) {
              if (!core::is_face(c.b)) c.post_b.v = c.pre_b.v;
            }}},
      {"moves-static-bodies",
       "a static body takes a hundredth of the correction",
       "center-of-mass",
       "errata:E3",
       {.store =
            [](const World& w, Contact& c) {
              if (!core::is_face(c.b) && w.bodies.is_static[c.b] != 0)
                c.post_b.x = c.pre_b.x - (0.01F * c.depth_m) * c.normal;
              if (w.bodies.is_static[c.a] != 0) c.post_a.x = c.pre_a.x + (0.01F * c.depth_m) * c.normal;
            },
        .moves_static = true}},
  });
  return kTable;
}

}  // namespace

std::span<const Mutant> contact_mutants() {
  return contact_table();
}

}  // namespace broadside::reference
