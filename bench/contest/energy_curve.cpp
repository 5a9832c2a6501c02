#include "bench/contest/energy_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/trace/trace_reader.hpp"

namespace broadside::bench::contest {
namespace {

using Vec = std::array<double, 3>;

double dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec wide(const core::Vec3& v) {
  return {v.x, v.y, v.z};
}
Vec wide(const core::WideVec3& v) {
  return {v.x, v.y, v.z};
}

// v + 2 w (u x v) + 2 u x (u x v), of the unit quaternion (w, u).
Vec turned(double w, const Vec& u, const Vec& v) {
  const Vec t = cross(u, v);
  const Vec s = cross(u, t);
  return {v[0] + 2 * (w * t[0] + s[0]), v[1] + 2 * (w * t[1] + s[1]), v[2] + 2 * (w * t[2] + s[2])};
}

struct State {
  Vec x, v, spin;  // of the mesh's origin; of the center of mass; world
  double w = 1.0;
  Vec u{};
};

State normalized(State s) {
  const double norm = std::sqrt(s.w * s.w + dot(s.u, s.u));
  if (norm > 0.0) {
    s.w /= norm;
    for (double& k : s.u) k /= norm;
  }
  return s;
}

// Wide where the trace has wide states.
State state_of(const core::FrameRecord& frame, std::size_t i) {
  if (frame.wide.position.size() > i) {
    const core::WideQuat& q = frame.wide.orientation[i];
    return normalized({wide(frame.wide.position[i]),
                       wide(frame.wide.velocity[i]),
                       wide(frame.wide.angular_velocity[i]),
                       q.w,
                       {q.x, q.y, q.z}});
  }
  const core::Quat& q = frame.orientation[i];
  return normalized(
      {wide(frame.position[i]), wide(frame.velocity[i]), wide(frame.angular_velocity[i]), q.w, {q.x, q.y, q.z}});
}

State start_of(const core::Body& b) {
  const core::Quat& q = b.orientation;
  return normalized({wide(b.position), wide(b.velocity), wide(b.angular_velocity), q.w, {q.x, q.y, q.z}});
}

// J; gravity's is zero where a center of mass is at the world's origin.
double energy(const core::Body& body, const core::MassProperties& p, const Vec& gravity, const State& s) {
  if (!(body.inverse_mass > 0.0F)) return 0.0;
  const double mass = 1.0 / static_cast<double>(body.inverse_mass);
  const Vec arm = turned(s.w, s.u, p.center_of_mass_m);
  const Vec x{s.x[0] + arm[0], s.x[1] + arm[1], s.x[2] + arm[2]};
  const Vec w = turned(s.w, {-s.u[0], -s.u[1], -s.u[2]}, s.spin);  // in the axes of the mesh
  const auto& [xx, yy, zz, xy, xz, yz] = p.inertia_kg_m2;
  const Vec l{xx * w[0] + xy * w[1] + xz * w[2], xy * w[0] + yy * w[1] + yz * w[2], xz * w[0] + yz * w[1] + zz * w[2]};
  return 0.5 * mass * dot(s.v, s.v) + 0.5 * dot(w, l) - mass * dot(gravity, x);
}

}  // namespace

core::Result<EnergyCurve> energy_curve(const std::filesystem::path& trace, std::size_t most_frames) {
  auto reader = core::TraceReader::open(trace);
  if (!reader) return reader.error();
  const core::Scene& scene = reader.value().header().scene;
  const auto mass = core::all_mass_properties(scene);
  if (!mass) return mass.error();
  const Vec gravity = wide(scene.gravity_m_s2);
  const std::size_t n = scene.bodies.size();
  const auto sum = [&](const auto& of) {
    double total = 0.0;
    for (std::size_t i = 0; i < n; ++i) total += energy(scene.bodies[i], mass.value()[i], gravity, of(i));
    return total;
  };
  const double first = sum([&](std::size_t i) { return start_of(scene.bodies[i]); });
  EnergyCurve curve{{0.0}, {0.0}};
  const std::uint64_t frames = reader.value().frame_count();
  const std::uint64_t stride = std::max<std::uint64_t>(1, (frames + most_frames - 1) / most_frames);
  for (std::uint64_t k = std::min(stride, std::max<std::uint64_t>(frames, 1)) - 1; k < frames;
       k = k + 1 == frames ? frames : std::min(k + stride, frames - 1)) {
    auto frame = reader.value().read(k, core::bit(core::Group::kBodies) | core::bit(core::Group::kWideBodies));
    if (!frame) return frame.error();
    if (frame.value().position.size() != n && frame.value().wide.position.size() != n) continue;
    curve.time_s.push_back(frame.value().time_s);
    curve.gained_j.push_back(sum([&](std::size_t i) { return state_of(frame.value(), i); }) - first);
  }
  return curve;
}

}  // namespace broadside::bench::contest
