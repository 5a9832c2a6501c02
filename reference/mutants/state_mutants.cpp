#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/method/integrate.hpp"
#include "core/method/response.hpp"
#include "reference/mutants/mutants.hpp"

namespace broadside::reference {
namespace {

using core::Contact;
using core::FrameRecord;
using core::Kinematics;
using core::Material;
using core::Parameters;
using core::Vec3;

bool is_static(const World& w, std::uint32_t body) {
  return w.bodies.is_static[body] != 0;
}

Kinematics sound_step(const World& w, std::uint32_t body, Vec3 acceleration) {
  return core::semi_implicit_euler(w.bodies.state[body], w.bodies.inverse_mass[body], acceleration, w.dt_s);
}

// Rounds to the 11 significant bits of float16, whatever the exponent.
float to_half(float v) {
  int exponent = 0;
  const float fraction = std::frexp(v, &exponent);
  return std::ldexp(std::nearbyint(fraction * 2048.0F), exponent - 11);
}

// The acceleration of the springs with other damping.
Vec3 spring_pull(const World& w, std::uint32_t body, float damping_factor) {
  Vec3 sum = w.scene->gravity_m_s2;
  for (core::Spring s : w.bodies.springs_of(body)) {
    s.damping_n_s_m *= damping_factor;
    sum = sum + core::spring_acceleration(s, w.bodies.state[body], w.bodies.inverse_mass[body]);
  }
  return sum;
}

std::span<const Mutant> state_table() {
  static const auto kTable = std::to_array<Mutant>({
      {"explicit-euler",
       "positions move with the velocity before gravity acted",
       "state-sanity",
       "mixed",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              Kinematics s = sound_step(w, i, a);
              if (!is_static(w, i)) s.x = w.bodies.state[i].x + w.dt_s * w.bodies.state[i].v;
              return s;
            }}},
      {"half-gravity",
       "half of gravity acts",
       "state-sanity",
       "mixed",
       {.integrate = [](const World& w, std::uint32_t i, Vec3 a) { return sound_step(w, i, 0.5F * a); }}},
      {"skips-a-step",
       "every tenth step, gravity is forgotten",
       "state-sanity",
       "mixed",
       {.integrate = [](const World& w, std::uint32_t i,
                        Vec3 a) { return sound_step(w, i, w.step % 10 == 0 ? Vec3{} : a); }}},
      {"gravity-upward",
       "gravity has the wrong sign",
       "state-sanity",
       "mixed",
       {.integrate = [](const World& w, std::uint32_t i, Vec3 a) { return sound_step(w, i, -1.0F * a); }}},
      {"static-bodies-fall",
       "static bodies are integrated too",
       "state-sanity",
       "mixed",
       {.integrate = [](const World& w, std::uint32_t i,
                        Vec3 a) { return core::semi_implicit_euler(w.bodies.state[i], 1.0F, a, w.dt_s); }}},
      {"half-precision",
       "positions are rounded to float16",
       "state-sanity",
       "mixed",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              Kinematics s = sound_step(w, i, a);
              for (int k = 0; k < 3; ++k) s.x[k] = to_half(s.x[k]);
              return s;
            }}},
      {"stale-boxes",
       "boxes are those of the frame before",
       "state-sanity",
       "mixed",
       {.box = [](const World& w,
                  std::uint32_t i) { return core::translated(w.bodies.local_box(i), w.last_state[i].x); }}},
      {"updates-boxes-every-other-frame",
       "boxes are refreshed in every other frame",
       "state-sanity",
       "mixed",
       {.box =
            [](const World& w, std::uint32_t i) {
              return w.step % 2 == 0 ? w.last_boxes[i] : core::translated(w.bodies.local_box(i), w.bodies.state[i].x);
            }}},
      {"boxes-ignore-lower-corner",
       "a box starts at the body's origin",
       "state-sanity",
       "mixed",
       {.box =
            [](const World& w, std::uint32_t i) {
              core::Box box = core::translated(w.bodies.local_box(i), w.bodies.state[i].x);
              box.min = w.bodies.state[i].x;
              return box;
            }}},
      {"detection-lags",
       "the recorded detection state is one frame old",
       "state-sanity",
       "mixed",
       {.tell =
            [](const World& w, FrameRecord& frame) {
              for (std::size_t i = 0; i < frame.detected_position.size(); ++i)
                frame.detected_position[i] = w.last_state[i].x;
            }}},
      {"loses-a-write",
       "what the last contact of a frame did to A is lost",
       "state-sanity",
       "mixed",
       {.end =
            [](World& w) {
              if (!w.contacts.empty() && !is_static(w, w.contacts.back().a))
                w.bodies.state[w.contacts.back().a] = w.contacts.back().pre_a;
            }}},
      {"no-ceiling",
       "the upper faces of the domain are open",
       "state-sanity",
       "leaving",
       {.face_geometry =
            [](const World&, std::uint32_t, int face, const core::ContactGeometry& sound) {
              core::ContactGeometry g = sound;
              g.exists = g.exists && face % 2 == 0;
              return g;
            }}},
      {"drifting-quaternions",
       "orientations lose their unit length",
       "state-sanity",
       "mixed",
       {.tell =
            [](const World& w, FrameRecord& frame) {
              for (core::Quat& q : frame.orientation) q.w *= 1.0F + 1e-5F * static_cast<float>(w.step);
            }}},
      {"clock-runs-fast",
       "time is counted in steps of a hundredth",
       "state-sanity",
       "mixed",
       {.tell = [](const World& w, FrameRecord& frame) { frame.time_s = 0.01 * static_cast<double>(w.step); }}},
      {"starts-elsewhere",
       "the first frame does not start from the scene",
       "state-sanity",
       "mixed",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              Kinematics s = sound_step(w, i, a);
              if (w.step == 1 && !is_static(w, i)) s.x.x += 0.01F;
              return s;
            }}},
      {"springs-without-damping",
       "dampers are left out",
       "stability",
       "springs:hanging",
       {.integrate = [](const World& w, std::uint32_t i, Vec3) { return sound_step(w, i, spring_pull(w, i, 0.0F)); }}},
      {"dampers-push",
       "dampers act along the velocity",
       "stability",
       "springs:hanging",
       {.integrate = [](const World& w, std::uint32_t i, Vec3) { return sound_step(w, i, spring_pull(w, i, -1.0F)); }}},
      {"springs-explicit",
       "bodies on springs move with the velocity before the springs acted",
       "stability",
       "springs:hanging",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              Kinematics s = sound_step(w, i, a);
              if (!is_static(w, i)) s.x = w.bodies.state[i].x + w.dt_s * w.bodies.state[i].v;
              return s;
            }}},
      {"order-of-threads",
       "contacts are resolved in an order that differs from run to run",
       "determinism",
       "pile",
       {.order =
            [](const World& w, Order& order) {
              for (std::size_t k = order.pairs.size(); k > 1; --k) {
                const std::size_t other = core::splitmix64(w.run * 1000 + w.step * 100 + k) % k;
                std::swap(order.pairs[k - 1], order.pairs[other]);
                std::swap(order.color[k - 1], order.color[other]);
              }
            }},
       Showing::kSecondRun},
      {"uninitialized-tangent",
       "where nothing slides, the tangent is whatever was in memory",
       "determinism",
       "mixed",
       {.store =
            [](const World& w, Contact& c) {
              if (c.tangent_impulse_n_s == 0.0F) c.tangent.x = 1e-3F * static_cast<float>(w.run + 1);
            }},
       Showing::kSecondRun},
      {"adds-in-any-order",
       "a sum over contacts is rounded in the order of the run",
       "determinism",
       "mixed",
       {.end =
            [](World& w) {
              for (const Contact& c : w.contacts)
                if (w.run % 2 != 0 && !is_static(w, c.a))
                  w.bodies.state[c.a].v.y = std::nextafter(w.bodies.state[c.a].v.y, 1.0F);
            }},
       Showing::kSecondRun},
      {"reads-the-clock",
       "the step is taken from a clock, not from dt",
       "determinism",
       "mixed",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              const float dt_s = w.dt_s * (1.0F + 1e-6F * static_cast<float>(w.run));
              return core::semi_implicit_euler(w.bodies.state[i], w.bodies.inverse_mass[i], a, dt_s);
            }},
       Showing::kSecondRun},
      {"material-of-lower-id",
       "a contact has the material of the body with the lower id",
       "metamorphic",
       "materials",
       {.combine = [](const Material& a, const Material&) { return a; }},
       Showing::kRenumbered},
      {"ids-break-pairs",
       "pairs of even ids count as tested",
       "metamorphic",
       "pile",
       {.candidates =
            [](World& w) {
              std::erase_if(w.candidates.pairs, [](core::Pair p) { return p.i % 2 == 0 && p.j % 2 == 0; });
              w.candidates.demanded = w.candidates.raw = w.candidates.pairs.size();
            }},
       Showing::kRenumbered},
      {"slop-in-meters",
       "the slop is 1 mm, whatever the scene says",
       "metamorphic",
       "two-body:unequal",
       {.respond = [](const World&, const Application& a) { a.apply_with([](Parameters& q) { q.delta_m = 0.001F; }); }},
       Showing::kScaled},
      {"threshold-in-meters",
       "the threshold speed is 0.3 m/s, whatever the scene says",
       "metamorphic",
       "two-body:slow",
       {.respond = [](const World&,
                      const Application& a) { a.apply_with([](Parameters& q) { q.v_threshold_m_s = 0.3F; }); }},
       Showing::kScaled},
      {"rounds-downward",
       "positions are rounded towards minus infinity",
       "metamorphic",
       "mixed",
       {.integrate =
            [](const World& w, std::uint32_t i, Vec3 a) {
              Kinematics s = sound_step(w, i, a);
              if (is_static(w, i)) return s;
              for (int k = 0; k < 3; ++k) {
                const double exact = static_cast<double>(w.bodies.state[i].x[k]) + static_cast<double>(w.dt_s) * s.v[k];
                if (s.x[k] > exact) s.x[k] = std::nextafter(s.x[k], -std::numeric_limits<float>::infinity());
              }
              return s;
            }},
       Showing::kMirrored},
  });
  return kTable;
}

}  // namespace

std::span<const Mutant> state_mutants() {
  return state_table();
}

}  // namespace broadside::reference
