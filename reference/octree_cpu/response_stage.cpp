#include "reference/octree_cpu/response_stage.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <random>

#include "core/method/contact_geometry.hpp"
#include "core/method/frame_digest.hpp"
#include "core/method/response.hpp"
#include "reference/octree_cpu/parallel_sum.hpp"

namespace broadside::reference {
namespace {

using core::Contact;
using core::Kinematics;
using core::Pair;

// Below this many contacts of one color, handing them to threads costs more than applying them: an application is some
// hundred nanoseconds, waking a worker some microseconds.
constexpr std::size_t kContactsPerTask = 64;

core::ContactGeometry geometry_now(const Bodies& bodies, const ResponseRules& rules, Pair p) {
  return core::box_contact(core::translated(bodies.local_box(p.i), bodies.state[p.i].x),
                           core::translated(bodies.local_box(p.j), bodies.state[p.j].x), rules.parameters.epsilon_m);
}

// Fills in the contact from the states before it, which it holds already.
void respond_to(const Bodies& bodies, const ResponseRules& rules, Pair p, const core::ContactGeometry& geometry,
                Contact& contact) {
  core::respond(contact, geometry, bodies.inverse_mass[p.i], bodies.inverse_mass[p.j],
                core::combine(bodies.material[p.i], bodies.material[p.j]), rules.parameters, rules.variant);
}

// A static body's post state is its pre state in every form but E3, which moves it; that is the point of E3.
bool is_written(const Bodies& bodies, const ResponseRules& rules, std::uint32_t body) {
  return bodies.is_static[body] == 0 || rules.variant == core::Variant::kE3;
}

// The racing form reads and writes each component on its own: no data race in the language's sense, every race in the
// algorithm's.
core::Vec3 racing_load(core::Vec3& v) {
  const auto load = [](float& f) { return std::atomic_ref<float>(f).load(std::memory_order_relaxed); };
  return {load(v.x), load(v.y), load(v.z)};
}

void racing_store(core::Vec3& to, core::Vec3 from) {
  const auto store = [](float& f, float value) { std::atomic_ref<float>(f).store(value, std::memory_order_relaxed); };
  store(to.x, from.x), store(to.y, from.y), store(to.z, from.z);
}

}  // namespace

void ResponseStage::apply(Bodies& bodies, const ResponseRules& rules, Pair p, std::uint32_t color, Contact& contact) {
  contact.a = p.i;
  contact.b = p.j;
  contact.color = color;
  contact.depth_m = 0.0F;
  const core::ContactGeometry geometry = geometry_now(bodies, rules, p);
  if (!geometry.exists) return;
  contact.pre_a = bodies.state[p.i];
  contact.pre_b = bodies.state[p.j];
  respond_to(bodies, rules, p, geometry, contact);
  if (is_written(bodies, rules, p.i)) bodies.state[p.i] = contact.post_a;
  if (is_written(bodies, rules, p.j)) bodies.state[p.j] = contact.post_b;
}

void ResponseStage::resolve_bodies(Bodies& bodies, const ResponseRules& rules, std::span<const Pair> touching) {
  contacts_.resize(touching.size());
  if (rules.solver == Solver::kJacobi) return resolve_jacobi(bodies, rules, touching);
  if (rules.solver == Solver::kRacing) return resolve_racing(bodies, rules, touching);

  never_written_.resize(bodies.count());
  for (std::uint32_t body = 0; body < bodies.count(); ++body) never_written_[body] = !is_written(bodies, rules, body);
  coloring_.color(touching, never_written_);
  const auto order = coloring_.order();
  const auto begin = coloring_.color_begin();
  for (std::uint32_t color = 0; color < coloring_.color_count(); ++color) {
    const auto run = [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) apply(bodies, rules, touching[order[k]], color, contacts_[k]);
    };
    if (begin[color + 1] - begin[color] < 2 * kContactsPerTask) {
      run(begin[color], begin[color + 1]);
      continue;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin[color], begin[color + 1], kContactsPerTask),
                      [&](const auto& range) { run(range.begin(), range.end()); });
  }
}

// Plain accumulation: every contact starts from the states before any response, and the changes are added up in the
// order of the pairs.
void ResponseStage::resolve_jacobi(Bodies& bodies, const ResponseRules& rules, std::span<const Pair> touching) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, touching.size(), kContactsPerTask), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) {
      Contact& contact = contacts_[k];
      const Pair p = touching[k];
      contact.a = p.i;
      contact.b = p.j;
      contact.color = 0;
      contact.depth_m = 0.0F;
      const core::ContactGeometry geometry = geometry_now(bodies, rules, p);
      if (!geometry.exists) continue;
      contact.pre_a = bodies.state[p.i];
      contact.pre_b = bodies.state[p.j];
      respond_to(bodies, rules, p, geometry, contact);
    }
  });
  sums_.assign(bodies.count(), {});
  const auto add = [this](std::uint32_t body, const Kinematics& pre, const Kinematics& post) {
    sums_[body].x = sums_[body].x + (post.x - pre.x);
    sums_[body].v = sums_[body].v + (post.v - pre.v);
  };
  for (const Contact& c : contacts_) {
    if (!(c.depth_m > 0.0F)) continue;
    add(c.a, c.pre_a, c.post_a);
    add(c.b, c.pre_b, c.post_b);
  }
  for (std::uint32_t body = 0; body < bodies.count(); ++body) {
    if (!is_written(bodies, rules, body)) continue;
    bodies.state[body].x = bodies.state[body].x + sums_[body].x;
    bodies.state[body].v = bodies.state[body].v + sums_[body].v;
  }
}

// E8: the contacts of a body are applied in the order in which threads reach them, and the last write stays. Which
// contact a thread takes next is drawn anew in each pass: a scheduler promises no order, but with few free cores it
// would repeat the same one.
void ResponseStage::resolve_racing(Bodies& bodies, const ResponseRules& rules, std::span<const Pair> touching) {
  std::vector<std::size_t> taken(touching.size());
  std::iota(taken.begin(), taken.end(), std::size_t{0});
  std::shuffle(taken.begin(), taken.end(), std::minstd_rand(std::random_device{}()));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, touching.size(), 1),
      [&](const auto& range) {
        for (std::size_t place = range.begin(); place != range.end(); ++place) {
          const std::size_t k = taken[place];
          Contact& contact = contacts_[k];
          const Pair p = touching[k];
          Kinematics& a = bodies.state[p.i];
          Kinematics& b = bodies.state[p.j];
          contact.a = p.i;
          contact.b = p.j;
          contact.color = 0;
          contact.depth_m = 0.0F;
          contact.pre_a = {racing_load(a.x), racing_load(a.v)};
          contact.pre_b = {racing_load(b.x), racing_load(b.v)};
          const core::ContactGeometry geometry =
              core::box_contact(core::translated(bodies.local_box(p.i), contact.pre_a.x),
                                core::translated(bodies.local_box(p.j), contact.pre_b.x), rules.parameters.epsilon_m);
          if (!geometry.exists) continue;
          respond_to(bodies, rules, p, geometry, contact);
          racing_store(a.x, contact.post_a.x), racing_store(a.v, contact.post_a.v);
          racing_store(b.x, contact.post_b.x), racing_store(b.v, contact.post_b.v);
        }
      },
      tbb::simple_partitioner());
}

void ResponseStage::resolve_faces(Bodies& bodies, const ResponseRules& rules) {
  const core::Variant variant = core::face_variant(rules.variant);
  face_contacts_.resize(bodies.count());
  touched_faces_.resize(bodies.count());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, bodies.count(), 256), [&](const auto& range) {
    for (std::uint32_t body = range.begin(); body != range.end(); ++body) {
      Kinematics& state = bodies.state[body];
      std::uint32_t touched = 0;
      for (int face = 0; face < core::kFaceCount; ++face) {
        if (bodies.is_static[body] != 0) continue;
        const core::ContactGeometry geometry =
            core::face_contact(core::translated(bodies.local_box(body), state.x), rules.domain, face);
        if (!geometry.exists) continue;
        Contact& contact = face_contacts_[body][face];
        contact.depth_m = 0.0F;
        contact.a = body;
        contact.b = core::kFirstFace + static_cast<std::uint32_t>(face);
        contact.color = core::kFaceColor;
        contact.pre_a = state;
        contact.pre_b = {};
        core::respond(contact, geometry, bodies.inverse_mass[body], 0.0F,
                      core::combine(bodies.material[body], rules.face_material), rules.parameters, variant);
        state = contact.post_a;
        if (contact.depth_m > 0.0F) touched |= 1U << static_cast<unsigned>(face);
      }
      touched_faces_[body] = static_cast<std::uint8_t>(touched);
      if (bodies.is_static[body] == 0) state.v = core::clipped(state.v, rules.parameters.v_max_m_s);
    }
  });
}

std::uint64_t ResponseStage::digest() const {
  const auto term = [](const Contact& c) { return c.depth_m > 0.0F ? core::contact_digest(c) : std::uint64_t{0}; };
  return parallel_sum_of(contacts_.size(), [&](std::size_t k) { return term(contacts_[k]); }) +
         parallel_sum_of(face_contacts_.size(), [&](std::size_t body) {
           std::uint64_t sum = 0;
           for (std::size_t face = 0; touched_faces_[body] >> face != 0; ++face)
             if ((touched_faces_[body] >> face & 1U) != 0U) sum += term(face_contacts_[body][face]);
           return sum;
         });
}

void ResponseStage::collect(std::vector<Contact>& contacts) const {
  contacts.clear();
  for (const Contact& c : contacts_)
    if (c.depth_m > 0.0F) contacts.push_back(c);
  for (std::size_t body = 0; body < face_contacts_.size(); ++body)
    for (std::size_t face = 0; touched_faces_[body] >> face != 0; ++face)
      if ((touched_faces_[body] >> face & 1U) != 0U) contacts.push_back(face_contacts_[body][face]);
}

}  // namespace broadside::reference
