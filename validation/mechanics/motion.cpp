#include "validation/mechanics/motion.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::validation {
namespace {

bool is_finite(Vec3d v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

core::Box joined_boxes(const core::Box& a, const core::Box& b) {
  core::Box box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = std::min(a.min[k], b.min[k]);
    box.max[k] = std::max(a.max[k], b.max[k]);
  }
  return box;
}

bool is_within(const core::Box& inner, const core::Box& outer) {
  for (int k = 0; k < 3; ++k)
    if (!(inner.min[k] > outer.min[k] && inner.max[k] < outer.max[k])) return false;
  return true;
}

bool do_boxes_meet(const core::Box& a, const core::Box& b) {
  for (int k = 0; k < 3; ++k)
    if (!(a.min[k] <= b.max[k] && b.min[k] <= a.max[k])) return false;
  return true;
}

// The box around the body's own box at this pose, moved by the shift and grown, rounded outward.
core::Box box_around(const BodyState& s, const BodyFacts& f, double grow, Vec3d shift) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Vec3d c = s.origin + s.r * f.box_center + shift;
  core::Box box;
  for (int k = 0; k < 3; ++k) {
    const Vec3d& row = s.r.row[static_cast<std::size_t>(k)];
    const double half =
        std::abs(row.x) * f.box_half.x + std::abs(row.y) * f.box_half.y + std::abs(row.z) * f.box_half.z;
    box.min[k] = std::nextafter(static_cast<float>(c[k] - half - grow), -kInf);
    box.max[k] = std::nextafter(static_cast<float>(c[k] + half + grow), kInf);
  }
  return box;
}

// Roots of a union of bodies, each the least body of its set.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = root(i);
    j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::string vector_text(Vec3d v) {
  return "(" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + ")";
}

double state_roundoff(const core::TraceHeader& header) {
  const bool is_wide = has(header, core::Group::kWideBodies) && header.declaration.text("precision") != "f32";
  return is_wide ? 0x1p-53 : kUnitRoundoff;
}

std::vector<BodyFacts> facts_of(const core::Scene& scene) {
  std::vector<BodyFacts> facts;
  std::vector<core::Box> boxes;
  std::vector<double> balls;
  for (const auto& mesh : scene.meshes) {
    boxes.push_back(core::bounds(*mesh));
    const auto primitive = core::primitive_of(*mesh);
    const bool is_ball = primitive && primitive->kind == core::PrimitiveKind::kSphere;
    balls.push_back(is_ball ? static_cast<double>(primitive->radius_m) : 0.0);
  }
  // A scene of bodies that translate may hold meshes that have no inertia.
  const auto mass = core::all_mass_properties(scene);
  for (std::uint32_t i = 0; i < scene.body_count(); ++i) {
    const core::Body& body = scene.bodies[i];
    BodyFacts f;
    f.mesh = body.mesh;
    f.is_dynamic = body.inverse_mass > 0.0F;
    const Vec3d low(boxes[body.mesh].min);
    const Vec3d high(boxes[body.mesh].max);
    f.box_center = 0.5 * (low + high);
    f.box_half = 0.5 * (high - low);
    // The closed shape that the mesh is a drawing of.
    f.ball_radius_m = balls[body.mesh];
    if (f.ball_radius_m > 0.0) f.box_center = {}, f.box_half = {f.ball_radius_m, f.ball_radius_m, f.ball_radius_m};
    f.smallest_side_m = 2.0 * std::min({f.box_half.x, f.box_half.y, f.box_half.z});
    if (f.is_dynamic) {
      f.mass_kg = 1.0 / static_cast<double>(body.inverse_mass);
      if (mass) {
        const auto& t = mass.value()[i].inertia_kg_m2;
        const auto& c = mass.value()[i].center_of_mass_m;
        f.has_inertia = true;
        f.center_of_mass = {c[0], c[1], c[2]};
        f.inertia = {{Vec3d{t[0], t[3], t[4]}, Vec3d{t[3], t[1], t[5]}, Vec3d{t[4], t[5], t[2]}}};
        f.inverse_inertia = inverse(f.inertia);
        const auto moments = core::principal_moments(t);
        f.least_moment = moments[0];
        f.largest_moment = moments[2];
      }
      if (scene.motion == core::Motion::kTranslate && scene.mass_properties.empty()) f.center_of_mass = {};
    }
    f.reach_m = length(f.box_center - f.center_of_mass) + length(f.box_half);
    facts.push_back(f);
  }
  for (const core::Spring& s : scene.springs)
    if (s.body < facts.size()) facts[s.body].has_spring = true;
  for (const core::Wrench& w : scene.wrenches) {
    const bool turns = w.axes == core::WrenchAxes::kBody;
    BodyFacts& f = facts[w.body];
    (turns ? f.force_body_n : f.force_world_n) = (turns ? f.force_body_n : f.force_world_n) + Vec3d(w.force_n);
    (turns ? f.torque_body_n_m : f.torque_world_n_m) =
        (turns ? f.torque_body_n_m : f.torque_world_n_m) + Vec3d(w.torque_n_m);
  }
  return facts;
}

MotionReader::MotionReader(const core::TraceHeader& header)
    : header_(header),
      facts_(facts_of(header.scene)),
      margin_m_(header.declaration.number("contact_margin_m") + header.scene.parameters.delta_m) {
  for (const BodyFacts& f : facts_) is_static_.push_back(f.is_dynamic ? 0 : 1);
  motion_.h = header.scene.dt_s;
  motion_.gravity = Vec3d(header.scene.gravity_m_s2);
  motion_.u = state_roundoff(header);
  motion_.substeps = header.declaration.number("substeps");
  motion_.facts = facts_;
  motion_.turns = header.scene.motion == core::Motion::kRigid;
  motion_.bodies.resize(facts_.size());
}

void MotionReader::complete(BodyState& s, std::size_t body) const {
  const BodyFacts& f = facts_[body];
  s.q = normalized(s.q);
  s.r = matrix_of(s.q);
  s.x = s.origin + s.r * f.center_of_mass;
  s.angular_momentum = f.has_inertia ? s.r * (f.inertia * transposed_times(s.r, s.w)) : Vec3d{};
}

BodyState MotionReader::start_of(std::size_t body) const {
  const core::Body& b = header_.scene.bodies[body];
  BodyState s;
  s.origin = Vec3d(b.position);
  s.q = to_quatd(b.orientation);
  s.v = Vec3d(b.velocity);
  s.w = Vec3d(b.angular_velocity);
  complete(s, body);
  return s;
}

std::optional<BodyState> MotionReader::state_of(const core::FrameRecord& frame, std::size_t body) const {
  BodyState s;
  if (frame.wide.position.size() == facts_.size()) {
    const auto wide = [](const core::WideVec3& v) { return Vec3d{v.x, v.y, v.z}; };
    s.origin = wide(frame.wide.position[body]);
    s.q = to_quatd(frame.wide.orientation[body]);
    s.v = wide(frame.wide.velocity[body]);
    s.w = wide(frame.wide.angular_velocity[body]);
  } else {
    s.origin = Vec3d(frame.position[body]);
    s.q = to_quatd(frame.orientation[body]);
    s.v = Vec3d(frame.velocity[body]);
    s.w = Vec3d(frame.angular_velocity[body]);
  }
  const double norm = squared_norm(s.q);
  const bool is_sane = is_finite(s.origin) && is_finite(s.v) && is_finite(s.w) && norm > 0.5 && norm < 2.0;
  if (!is_sane) return std::nullopt;
  complete(s, body);
  return s;
}

void MotionReader::read_between(const core::FrameRecord& frame) {
  motion_.between.clear();
  const std::size_t n = facts_.size();
  if (n == 0 || frame.part_poses.size() % n != 0) return;
  for (std::size_t k = 0; k < frame.part_poses.size(); ++k) {
    BodyState s;
    s.origin = Vec3d(frame.part_poses[k].position);
    s.q = to_quatd(frame.part_poses[k].orientation);
    const double norm = squared_norm(s.q);
    if (!is_finite(s.origin) || !(norm > 0.5 && norm < 2.0)) {
      motion_.between.clear();
      return;
    }
    complete(s, k % n);
    motion_.between.push_back(s);
  }
}

core::Box MotionReader::predicted_box(std::size_t body) const {
  const BodyFacts& f = facts_[body];
  const BodyState& s = motion_.bodies[body].before;
  if (!f.is_dynamic) return box_around(s, f, margin_m_, {});
  // A turn moves no point of the body by more than its reach times the angle, nor by more than twice its reach. The
  // spin of a free body grows at most until all its energy is about the axis of the least moment.
  const double growth = f.has_inertia ? std::sqrt(f.largest_moment / f.least_moment) : 1.0;
  const double swing = f.reach_m * std::min(2.0, motion_.h * length(s.w) * growth);
  const double grow = swing + margin_m_;
  const core::Box start = box_around(s, f, grow, {});
  const core::Box drifted = box_around(s, f, grow, motion_.h * s.v);
  const core::Box fallen = box_around(s, f, grow, motion_.h * (s.v + motion_.h * motion_.bodies[body].acceleration));
  return joined_boxes(joined_boxes(start, drifted), fallen);
}

core::Box MotionReader::swept_box(std::size_t body) const {
  const BodyFacts& f = facts_[body];
  core::Box swept = predicted_[body];
  for (std::size_t part = 0; part < motion_.parts(); ++part) {
    const BodyState& from = motion_.pose_after(part, body);
    const BodyState& to = motion_.pose_after(part + 1, body);
    // Between two poses an extent is above both ends' by at most reach (1 - cos(angle / 2)).
    const double angle = angle_of(to.q * conjugate(from.q));
    const double grow = f.reach_m * std::min(1.0, angle * angle / 8.0) + margin_m_;
    swept = joined_boxes(swept, joined_boxes(box_around(from, f, grow, {}), box_around(to, f, grow, {})));
  }
  return swept;
}

void MotionReader::find_touchable() {
  const core::Box& d = header_.scene.domain;
  for (std::size_t i = 0; i < facts_.size(); ++i) is_touchable_[i] = is_within(predicted_[i], d) ? 0 : 1;
  for (const core::Pair p : motion_.near)
    if (do_boxes_meet(predicted_[p.i], predicted_[p.j])) is_touchable_[p.i] = is_touchable_[p.j] = 1;
  // A body that may have been deflected may meet others that were not.
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (const core::Pair p : motion_.near) {
      if (is_touchable_[p.i] == is_touchable_[p.j]) continue;
      const auto [from, to] = is_touchable_[p.i] != 0 ? std::pair(p.i, p.j) : std::pair(p.j, p.i);
      if (!do_boxes_meet(swept_[from], predicted_[to])) continue;
      is_touchable_[to] = 1;
      is_changed = true;
    }
  }
}

void MotionReader::find_neighbors() {
  const std::size_t n = facts_.size();
  predicted_.resize(n);
  swept_.resize(n);
  is_touchable_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    predicted_[i] = predicted_box(i);
    swept_[i] = swept_box(i);
  }
  motion_.near = join_.join(swept_, is_static_);
  find_touchable();
  Sets sets(n);
  std::vector<std::uint8_t> is_held(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    motion_.bodies[i].is_alone = is_touchable_[i] == 0 && facts_[i].is_dynamic;
    is_held[i] = is_within(swept_[i], header_.scene.domain) ? 0 : 1;
  }
  for (const core::Pair p : motion_.near) {
    if (is_touchable_[p.i] == 0 || is_touchable_[p.j] == 0) continue;
    if (is_static_[p.i] != 0 || is_static_[p.j] != 0)
      is_held[is_static_[p.i] != 0 ? p.j : p.i] = 1;
    else
      sets.join(p.i, p.j);
  }
  motion_.set_is_free.assign(n, 1);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t set = sets.root(i);
    motion_.bodies[i].set = set;
    if (is_held[i] != 0 || is_static_[i] != 0 || facts_[i].has_spring) motion_.set_is_free[set] = 0;
  }
}

void MotionReader::find_pulls() {
  motion_.strongest_pull = length(motion_.gravity);
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    const BodyFacts& f = facts_[i];
    BodyStep& b = motion_.bodies[i];
    const Vec3d force = f.force_world_n + b.before.r * f.force_body_n;
    const double inverse_mass = f.is_dynamic ? 1.0 / f.mass_kg : 0.0;
    const double turn =
        angle_of(b.after.q * conjugate(b.before.q)) + motion_.h * std::max(length(b.before.w), length(b.after.w));
    b.acceleration = motion_.gravity + inverse_mass * force;
    b.acceleration_slack = inverse_mass * turn * length(f.force_body_n);
    b.torque = f.torque_world_n_m + b.before.r * f.torque_body_n_m;
    b.torque_slack = turn * length(f.torque_body_n_m);
    b.is_torque_free = length(f.torque_world_n_m) == 0.0 && length(f.torque_body_n_m) == 0.0;
    motion_.strongest_pull = std::max(motion_.strongest_pull, length(b.acceleration));
  }
}

const Motion* MotionReader::read(const core::FrameRecord& frame, const core::FrameRecord* previous) {
  const std::size_t n = facts_.size();
  const auto has_states = [n](const core::FrameRecord& f) {
    return f.position.size() == n && f.velocity.size() == n && f.orientation.size() == n &&
           f.angular_velocity.size() == n;
  };
  const bool is_first = frame.step == 1;
  const bool follows = previous != nullptr && previous->step + 1 == frame.step && has_states(*previous);
  if ((!is_first && !follows) || !has_states(frame)) return nullptr;
  motion_.step = frame.step;
  for (std::size_t i = 0; i < n; ++i) {
    const auto after = state_of(frame, i);
    const auto before = follows ? state_of(*previous, i) : std::optional(start_of(i));
    if (!before || !after) return nullptr;
    motion_.bodies[i].before = *before;
    motion_.bodies[i].after = *after;
  }
  read_between(frame);
  find_pulls();
  find_neighbors();
  return &motion_;
}

ExactShapes::ExactShapes(const core::Scene& scene) {
  for (const auto& mesh : scene.meshes) cores_.push_back(exact::convex_core_of(*mesh));
}

exact::ConvexCore ExactShapes::placed(std::uint32_t mesh, Vec3d origin, Quatd q) const {
  exact::ConvexCore core = *cores_[mesh];
  const Mat3d r = matrix_of(q);
  const auto turned = [&r](exact::Point p) { return r * to_vec3d(p); };
  for (exact::Point& p : core.vertices) p = to_point(origin + turned(p));
  for (exact::Point& p : core.normals) p = to_point(turned(p));
  for (exact::Point& p : core.directions) p = to_point(turned(p));
  return core;
}

}  // namespace broadside::validation
