#include "reference/plain_rigid/plain_world.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "core/method/frame_digest.hpp"
#include "core/scene/refuse_springs.hpp"
#include "reference/plain_rigid/impacts.hpp"
#include "reference/plain_rigid/scene_bodies.hpp"

namespace broadside::reference::plain {
namespace {

using core::Status;

core::Vec3 narrow(Vec v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
core::WideVec3 wide(Vec v) {
  return {v.x, v.y, v.z};
}

// The most parts of a turn in one step: a body that turns by more than this many rad is not integrated more finely.
constexpr double kMostParts = 1000.0;
// Order by bodies, so that the points of two bodies are next to each other.
bool is_before(const SolverPoint& p, const SolverPoint& q) {
  return p.a != q.a ? p.a < q.a : p.b < q.b;
}
bool is_same(Vec p, Vec q) {
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

}  // namespace

Status PlainWorld::load(const core::Scene& scene) {
  if (Status s = core::refuse_springs(scene); !s) return s;
  scene_ = &scene;
  steps_ = 0;
  sweeps_ = 0;
  bodies_.clear();
  points_.clear();
  carried_.clear();
  const auto mass = core::all_mass_properties(scene);
  if (!mass) return mass.error();
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    auto body = body_of(scene, i, mass.value()[i]);
    if (!body) return body.error();
    bodies_.push_back(body.value());
    // Bodies that translate have no inverse inertia: nothing turns them.
    if (scene.motion == core::Motion::kTranslate) {
      bodies_.back().inverse_inertia = {{Vec{}, Vec{}, Vec{}}};
      bodies_.back().angular_momentum = {};
    }
  }
  for (const core::Wrench& w : scene.wrenches) {
    RigidBody& b = bodies_[w.body];
    const bool turns = w.axes == core::WrenchAxes::kBody;
    (turns ? b.force_body : b.force_world) = (turns ? b.force_body : b.force_world) + vec(w.force_n);
    (turns ? b.torque_body : b.torque_world) = (turns ? b.torque_body : b.torque_world) + vec(w.torque_n_m);
  }
  return core::Done{};
}

core::Box PlainWorld::box_of(const RigidBody& b) const {
  const Vec c = b.origin();
  const Mat r = b.rotation();
  core::Box box;
  for (int k = 0; k < 3; ++k) {
    double low = -b.radius;
    double high = b.radius;
    if (!b.is_sphere()) {
      low = std::numeric_limits<double>::infinity();
      high = -low;
      for (const Vec p : b.polytope->vertices) {
        const double at = dot(r.row[static_cast<std::size_t>(k)], p);
        low = std::min(low, at);
        high = std::max(high, at);
      }
    }
    // Rounded outward, so that the recorded box contains the shape.
    box.min[k] = std::nextafter(static_cast<float>(c[k] + low), -std::numeric_limits<float>::infinity());
    box.max[k] = std::nextafter(static_cast<float>(c[k] + high), std::numeric_limits<float>::infinity());
  }
  return box;
}

double PlainWorld::farthest(const RigidBody& b, double h) const {
  if (b.is_static()) return 0.0;
  // However fast it spins, no point is farther than the diameter from where it was.
  const double swing = std::min(h * length(b.angular_velocity()), 2.0) * b.reach;
  return h * (length(b.v) + h * length(pull(b))) + swing;
}

Vec PlainWorld::pull(const RigidBody& b) const {
  return b.is_static() ? Vec{} : vec(scene_->gravity_m_s2) + b.inverse_mass * b.force();
}

void PlainWorld::add_pair(std::uint32_t a, std::uint32_t b, double h) {
  std::vector<NearPoint> found;
  near_points(bodies_[a], bodies_[b], farthest(bodies_[a], h) + farthest(bodies_[b], h), found);
  for (const NearPoint& p : found)
    points_.push_back({a, b, p, core::combine(bodies_[a].material, bodies_[b].material), 0.0, 0.0, {}, {}});
}

void PlainWorld::add_faces(std::uint32_t a, double h) {
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
    std::vector<NearPoint> found;
    near_points(bodies_[a], scene_->domain, face, farthest(bodies_[a], h), found);
    for (const NearPoint& p : found)
      points_.push_back(
          {a, core::kFirstFace + face, p, core::combine(bodies_[a].material, scene_->face_material), 0.0, 0.0, {}, {}});
  }
}

// Boxes are grown by the distance that may close within h, and sorted along x.
void PlainWorld::find_points(double h) {
  points_.clear();
  struct Reach {
    double low[3];
    double high[3];
  };
  std::vector<Reach> reach(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const core::Box box = box_of(bodies_[i]);
    const double grow = farthest(bodies_[i], h);
    for (int k = 0; k < 3; ++k) reach[i].low[k] = box.min[k] - grow, reach[i].high[k] = box.max[k] + grow;
  }
  std::vector<std::uint32_t> order(bodies_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return reach[p].low[0] != reach[q].low[0] ? reach[p].low[0] < reach[q].low[0] : p < q;
  });
  std::vector<core::Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && reach[order[j]].low[0] <= reach[order[i]].high[0]; ++j) {
      const Reach& p = reach[order[i]];
      const Reach& q = reach[order[j]];
      const bool overlap =
          p.low[1] <= q.high[1] && q.low[1] <= p.high[1] && p.low[2] <= q.high[2] && q.low[2] <= p.high[2];
      if (overlap && !(bodies_[order[i]].is_static() && bodies_[order[j]].is_static()))
        pairs.push_back(core::make_pair_of(order[i], order[j]));
    }
  std::sort(pairs.begin(), pairs.end());
  for (const core::Pair p : pairs) add_pair(p.i, p.j, h);
  for (std::uint32_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].is_static()) add_faces(i, h);
  std::stable_sort(points_.begin(), points_.end(), is_before);
}

void PlainWorld::solve_impacts(double h) {
  std::vector<SolverPoint> hits;
  std::vector<std::size_t> index;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const SolverPoint& p = points_[k];
    const Vec vb = core::is_face(p.b) ? Vec{} : velocity_at(bodies_[p.b], p.at.point);
    const double approach = -dot(velocity_at(bodies_[p.a], p.at.point) - vb, p.at.normal);
    const Vec pulled = pull(bodies_[p.a]) - (core::is_face(p.b) ? Vec{} : pull(bodies_[p.b]));
    const double closing = h * (approach - h * dot(pulled, p.at.normal));
    const bool is_hit = approach > scene_->parameters.v_threshold_m_s && p.at.gap < closing;
    if (!is_hit) continue;
    hits.push_back(p);
    hits.back().least_speed = p.surface.restitution * approach;
    index.push_back(k);
  }
  sweeps_ += solve_rebounds(hits, bodies_, options_.iterations);
  for (std::size_t k = 0; k < hits.size(); ++k) points_[index[k]].total_impulse = hits[k].total_impulse;
}

// A struck body may move farther within h than detection assumed: then more points are found, at the same poses. Points
// that were found before are kept, with their impulses.
void PlainWorld::find_points_of_struck(double h) {
  const auto is_struck = [](const SolverPoint& p) { return dot(p.total_impulse, p.total_impulse) > 0.0; };
  if (std::none_of(points_.begin(), points_.end(), is_struck)) return;
  std::vector<SolverPoint> before;
  before.swap(points_);
  find_points(h);
  std::vector<SolverPoint> others;
  for (const SolverPoint& p : before) {
    const auto [first, last] = std::equal_range(points_.begin(), points_.end(), p, is_before);
    const auto same = std::find_if(first, last, [&p](const SolverPoint& q) { return is_same(p.at.point, q.at.point); });
    if (same != last)
      same->total_impulse = p.total_impulse;
    else
      others.push_back(p);
  }
  points_.insert(points_.end(), others.begin(), others.end());
  std::stable_sort(points_.begin(), points_.end(), is_before);
}

void PlainWorld::accelerate(double h) {
  for (RigidBody& b : bodies_)
    if (!b.is_static()) {
      b.v = b.v + h * pull(b);
      b.angular_momentum = b.angular_momentum + h * b.torque();
    }
}

// A point starts with the impulses of the point that was nearest to it on A in the step before, so that bodies at rest
// need few sweeps.
void PlainWorld::start_warm() {
  constexpr double kNear = 0.05;  // of the body's reach: farther ones are other corners
  for (SolverPoint& p : points_) {
    const RigidBody& a = bodies_[p.a];
    const Vec local = transposed(a.rotation()) * (p.at.point - a.x);
    const auto [first, last] =
        std::equal_range(carried_.begin(), carried_.end(), Carried{p.a, p.b, {}, 0.0, {}},
                         [](const Carried& x, const Carried& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    double least = kNear * a.reach;
    for (auto c = first; c != last; ++c) {
      if (!(length(c->local - local) < least)) continue;
      least = length(c->local - local);
      p.normal_impulse = c->normal_impulse;
      p.friction_impulse = c->friction_impulse - dot(c->friction_impulse, p.at.normal) * p.at.normal;
    }
  }
}

void PlainWorld::carry() {
  carried_.clear();
  for (const SolverPoint& p : points_) {
    const RigidBody& a = bodies_[p.a];
    if (p.normal_impulse > 0.0)
      carried_.push_back(
          {p.a, p.b, transposed(a.rotation()) * (p.at.point - a.x), p.normal_impulse, p.friction_impulse});
  }
  std::stable_sort(carried_.begin(), carried_.end(),
                   [](const Carried& x, const Carried& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
}

void PlainWorld::solve_contacts(double h) {
  for (SolverPoint& p : points_) p.least_speed = p.at.gap > 0.0 ? -p.at.gap / h : 0.0;
  struct Motion {
    Vec v;
    Vec angular_momentum;
  };
  std::vector<Motion> free;
  for (const RigidBody& b : bodies_) free.push_back({b.v, b.angular_momentum});
  start_warm();
  sweeps_ += solve_velocities(points_, bodies_, options_.iterations);
  carry();
  for (SolverPoint& p : points_) {
    if (p.normal_impulse > 0.0) {
      is_touched_[p.a] = 1;
      if (!core::is_face(p.b)) is_touched_[p.b] = 1;
    }
    p.finish_solve();
  }
  // Sweeps gave impulses to bodies and took them back where nothing touches in the end. What remains is rounding, and
  // is removed.
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (is_touched_[i] == 0) bodies_[i].v = free[i].v, bodies_[i].angular_momentum = free[i].angular_momentum;
}

void PlainWorld::move(double h) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    RigidBody& b = bodies_[i];
    if (b.is_static()) continue;
    b.x = b.x + (is_touched_[i] != 0 ? h * b.v : (0.5 * h) * (velocity_before_gravity_[i] + b.v));
    turn(b, h);
  }
}

// The classical Runge-Kutta method on dq/dt = (0, w(q)) q / 2 with constant angular momentum. It takes parts of at most
// 1 rad, shorter ones for slender bodies: a stage that turns by an angle t changes the spin about the long axis by t^2
// / 2 times the ratio of the moments.
void PlainWorld::turn(RigidBody& b, double step) {
  const double parts = std::max(1.0, std::ceil(step * length(b.angular_velocity()) * b.slenderness));
  for (double k = 0.0; k < parts && k < kMostParts; k += 1.0) turn_part(b, step / std::min(parts, kMostParts));
}

void PlainWorld::turn_part(RigidBody& b, double h) {
  const auto spin = [&b](Quaternion q) { return b.world_spin(b.angular_momentum, q); };
  const Quaternion q0 = b.q;
  const Quaternion q1 = moved(q0, q0, spin(q0), 0.5 * h);
  const Quaternion q2 = moved(q0, q1, spin(q1), 0.5 * h);
  const Quaternion q3 = moved(q0, q2, spin(q2), h);
  Quaternion sum = moved(q0, q0, spin(q0), h / 6.0);
  sum = moved(sum, q1, spin(q1), h / 3.0);
  sum = moved(sum, q2, spin(q2), h / 3.0);
  sum = moved(sum, q3, spin(q3), h / 6.0);
  b.q = normalized(sum);
}

void PlainWorld::separate() {
  correct_positions(points_, bodies_, {options_.iterations, scene_->parameters.delta_m, 0.2});
}

Status PlainWorld::step(float dt_s) {
  const double h = dt_s;
  begin_record();
  find_points(h);
  solve_impacts(h);
  find_points_of_struck(h);
  velocity_before_gravity_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) velocity_before_gravity_[i] = bodies_[i].v;
  accelerate(h);
  is_touched_.assign(bodies_.size(), 0);
  solve_contacts(h);
  move(h);
  separate();
  for (const SolverPoint& p : points_) {
    const bool acts = dot(p.total_impulse, p.total_impulse) > 0.0;
    if (!acts && p.at.gap > 0.0) continue;
    recorded_.push_back(
        {p.a, p.b, narrow(p.at.point), narrow(p.at.normal), static_cast<float>(p.at.gap), narrow(p.total_impulse), 0});
  }
  ++steps_;
  return core::Done{};
}

void PlainWorld::begin_record() {
  recorded_.clear();
  detected_ = {};
  for (const RigidBody& b : bodies_) {
    detected_.detected_position.push_back(narrow(b.origin()));
    detected_.detected_velocity.push_back(narrow(b.v));
    detected_.detected_orientation.push_back(
        {static_cast<float>(b.q.w), static_cast<float>(b.q.x), static_cast<float>(b.q.y), static_cast<float>(b.q.z)});
    detected_.boxes.push_back(box_of(b));
  }
}

Status PlainWorld::read_back(core::FrameRecord& frame, core::RecordLevel level) {
  frame = {};
  frame.step = steps_;
  frame.time_s = static_cast<double>(steps_) * scene_->dt_s;
  if (level == core::RecordLevel::kFull) {
    frame.detected_position = detected_.detected_position;
    frame.detected_velocity = detected_.detected_velocity;
    frame.detected_orientation = detected_.detected_orientation;
    frame.boxes = detected_.boxes;
  }
  frame.points = recorded_;
  for (const RigidBody& b : bodies_) {
    frame.wide.position.push_back(wide(b.origin()));
    frame.wide.orientation.push_back({b.q.w, b.q.x, b.q.y, b.q.z});
    frame.wide.velocity.push_back(wide(b.v));
    frame.wide.angular_velocity.push_back(wide(b.angular_velocity()));
  }
  record(frame);
  for (std::size_t i = 0; i < frame.wide.position.size(); ++i) {
    frame.position.push_back(core::narrowed(frame.wide.position[i]));
    frame.orientation.push_back(core::narrowed(frame.wide.orientation[i]));
    frame.velocity.push_back(core::narrowed(frame.wide.velocity[i]));
    frame.angular_velocity.push_back(core::narrowed(frame.wide.angular_velocity[i]));
  }
  // SCHEMA.md defines the digest over the float32 values of a trace; determinism compares the other fields themselves.
  for (std::uint32_t i = 0; i < bodies_.size(); ++i)
    frame.digest +=
        core::body_digest(i, frame.position[i], frame.orientation[i], frame.velocity[i], frame.angular_velocity[i]);
  if (level == core::RecordLevel::kFull) return core::Done{};
  const core::FrameRecord bare{frame.step, frame.time_s, frame.digest};
  frame = bare;
  return core::Done{};
}

std::vector<core::Counter> PlainWorld::counters() const {
  return {{"contact sweeps", sweeps_}};
}

std::uint32_t PlainWorld::groups() const {
  using core::Group;
  return bit(Group::kBodies) | bit(Group::kWideBodies) | bit(Group::kDetection) | bit(Group::kDetectedOrientation) |
         bit(Group::kPoints);
}

}  // namespace broadside::reference::plain
