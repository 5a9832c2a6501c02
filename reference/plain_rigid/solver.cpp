#include "reference/plain_rigid/solver.hpp"

#include <algorithm>

#include "core/contact.hpp"

namespace broadside::reference::plain {
namespace {

// A body's part in one point, with its inverse inertia in the world.
struct Side {
  RigidBody* body = nullptr;  // null for a face of the domain or a static body
  Mat inverse_inertia;
  Vec arm;
};

Side side_of(std::vector<RigidBody>& bodies, std::uint32_t id, Vec point) {
  if (core::is_face(id) || bodies[id].is_static()) return {};
  RigidBody& b = bodies[id];
  const Mat r = b.rotation();
  return {&b, r * (b.inverse_inertia * transposed(r)), point - b.x};
}

Vec speed(const Side& s) {
  if (s.body == nullptr) return {};
  return s.body->v + cross(s.inverse_inertia * s.body->angular_momentum, s.arm);
}

// How much faster the point moves along d for an impulse of 1 N s along d.
double mobility(const Side& s, Vec d) {
  if (s.body == nullptr) return 0.0;
  const Vec turning = cross(s.arm, d);
  return s.body->inverse_mass + dot(turning, s.inverse_inertia * turning);
}

void push(const Side& s, Vec impulse) {
  if (s.body == nullptr) return;
  s.body->v = s.body->v + s.body->inverse_mass * impulse;
  s.body->angular_momentum = s.body->angular_momentum + cross(s.arm, impulse);
}

struct Row {
  SolverPoint* point = nullptr;
  Side a;
  Side b;
  double normal_mobility = 0.0;
  double tangent_mobility = 0.0;  // of the tangent direction that yields least: so a step never overshoots

  [[nodiscard]] Vec relative() const { return speed(a) - speed(b); }
  void apply(Vec impulse) const {
    push(a, impulse);
    push(b, -impulse);
  }
};

Row row_of(SolverPoint& p, std::vector<RigidBody>& bodies) {
  Row row{&p, side_of(bodies, p.a, p.at.point), side_of(bodies, p.b, p.at.point), 0.0, 0.0};
  const Vec n = p.at.normal;
  row.normal_mobility = mobility(row.a, n) + mobility(row.b, n);
  const Vec t = perpendicular(n);
  const Vec u = cross(n, t);
  // The sum bounds the larger eigenvalue of the 2 x 2 mobility of the tangent plane from above.
  const double tt = mobility(row.a, t) + mobility(row.b, t);
  const double uu = mobility(row.a, u) + mobility(row.b, u);
  const Vec both = 0.70710678118654752 * (t + u);
  const double tu = 0.5 * (2.0 * (mobility(row.a, both) + mobility(row.b, both)) - tt - uu);
  row.tangent_mobility = 0.5 * (tt + uu) + std::sqrt(0.25 * (tt - uu) * (tt - uu) + tu * tu);
  return row;
}

// keeps_sliding: a point that slid in the sweep before slides in this one too. Otherwise sweeps would not settle,
// because a point would change between its two coefficients of friction. Returns by how much the point's velocity had
// to change, m/s.
double solve(const Row& row, bool keeps_sliding) {
  SolverPoint& p = *row.point;
  const Vec n = p.at.normal;
  const double before = p.normal_impulse;
  p.normal_impulse = std::max(0.0, before + (p.least_speed - dot(row.relative(), n)) / row.normal_mobility);
  row.apply((p.normal_impulse - before) * n);

  const Vec relative = row.relative();
  const Vec slip = relative - dot(relative, n) * n;
  const Vec old = p.friction_impulse;
  Vec wanted = old - (1.0 / row.tangent_mobility) * slip;
  const double size = length(wanted);
  p.slides = (p.slides && keeps_sliding) || size > p.surface.mu_static * p.normal_impulse;
  const double most = (p.slides ? p.surface.mu_kinetic : p.surface.mu_static) * p.normal_impulse;
  if (size > most) wanted = size > 0.0 ? (most / size) * wanted : Vec{};
  p.friction_impulse = wanted;
  row.apply(wanted - old);
  return std::max(std::abs(p.normal_impulse - before) * row.normal_mobility,
                  length(wanted - old) * row.tangent_mobility);
}

// One forward and one backward pass, so that no end of a stack is favored. Returns the largest change, m/s.
double sweep(const std::vector<Row>& rows, bool keeps_sliding) {
  double change = 0.0;
  for (auto row = rows.begin(); row != rows.end(); ++row) change = std::max(change, solve(*row, keeps_sliding));
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) change = std::max(change, solve(*row, keeps_sliding));
  return change;
}

Vec impulse_of(const SolverPoint& p) {
  return p.normal_impulse * p.at.normal + p.friction_impulse;
}

// Conjugate directions over what sweeps change: Silcowitz, Niebe and Erleben, A nonsmooth nonlinear conjugate gradient
// method for interactive contact force problems (2010), Fletcher and Reeves's rule. Sizes are in the points'
// mobilities.
class Directions {
 public:
  explicit Directions(const std::vector<Row>& rows) : rows_(rows), before_(rows.size()), way_(rows.size()) {}

  void begin_sweep() {
    for (std::size_t k = 0; k < rows_.size(); ++k) before_[k] = impulse_of(*rows_[k].point);
  }

  // Continues along the last direction as far as the last two sweeps suggest, or restarts the directions.
  void follow() {
    double size = 0.0;
    std::vector<Vec> step(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      step[k] = impulse_of(*rows_[k].point) - before_[k];
      size += dot(step[k], step[k]) * rows_[k].normal_mobility;
    }
    const double share = last_size_ > 0.0 ? size / last_size_ : 0.0;
    last_size_ = size;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Vec more = share <= 1.0 ? share * way_[k] : Vec{};
      way_[k] = more + step[k];
      SolverPoint& p = *rows_[k].point;
      const double along = dot(more, p.at.normal);
      p.normal_impulse += along;
      p.friction_impulse = p.friction_impulse + (more - along * p.at.normal);
      rows_[k].apply(more);
    }
  }

 private:
  const std::vector<Row>& rows_;
  std::vector<Vec> before_;
  std::vector<Vec> way_;
  double last_size_ = 0.0;
};

// Sweeps are done when they change velocities by no more than this share of what they began with. Gravity's gain in a
// step of 1/60 s is 0.16 m/s: what is left is below 1e-6 m/s, and the next step goes on from there.
constexpr double kDone = 0x1p-18;

}  // namespace

std::uint32_t solve_velocities(std::vector<SolverPoint>& points, std::vector<RigidBody>& bodies,
                               std::uint32_t iterations) {
  std::vector<Row> rows;
  double fastest = 0.0;
  for (SolverPoint& p : points)
    if (Row row = row_of(p, bodies); row.normal_mobility > 0.0) rows.push_back(row);
  for (const Row& row : rows) fastest = std::max({fastest, length(row.relative()), row.point->least_speed});
  for (const Row& row : rows) row.apply(impulse_of(*row.point));
  Directions directions(rows);
  for (std::uint32_t k = 1; k <= iterations; ++k) {
    directions.begin_sweep();
    // A sweep comes last: it leaves every impulse within its cone.
    if (sweep(rows, 2 * k >= iterations) <= kDone * fastest || k == iterations) return k;
    directions.follow();
  }
  return 0;
}

void correct_positions(const std::vector<SolverPoint>& points, std::vector<RigidBody>& bodies,
                       const SolverOptions& options) {
  // The points of two bodies are next to each other: the deepest of them says how far these bodies are moved apart.
  // Bodies are moved and never turned.
  for (std::size_t first = 0, last = 0; first < points.size(); first = last) {
    const SolverPoint* deepest = &points[first];
    for (last = first; last < points.size() && points[last].a == points[first].a && points[last].b == points[first].b;
         ++last)
      if (points[last].at.gap < deepest->at.gap) deepest = &points[last];
    const double depth = -deepest->at.gap - options.slop_m;
    if (!(depth > 0.0)) continue;
    RigidBody& a = bodies[deepest->a];
    RigidBody* b = core::is_face(deepest->b) || bodies[deepest->b].is_static() ? nullptr : &bodies[deepest->b];
    const double mobility = a.inverse_mass + (b == nullptr ? 0.0 : b->inverse_mass);
    if (!(mobility > 0.0)) continue;
    const Vec way = (options.correction_rate * depth / mobility) * deepest->at.normal;
    a.x = a.x + a.inverse_mass * way;
    if (b != nullptr) b->x = b->x - b->inverse_mass * way;
  }
}

}  // namespace broadside::reference::plain
