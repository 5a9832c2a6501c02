#include "bench/forensics/replay_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contact.hpp"
#include "validation/rounding.hpp"

namespace broadside::bench {
namespace {

using core::bit;
using core::Group;
using validation::kSubnormal;
using validation::rounding;

constexpr double kTwoEngines = 2.0;
// Rounded operations behind dt g: in our engines, and in an engine that computes forces first.
constexpr int kOurPull = 1;
constexpr int kTheirPull = 5;
const double kDiagonal = std::sqrt(3.0);

double largest(core::Vec3 v) {
  return std::max({std::abs(double{v.x}), std::abs(double{v.y}), std::abs(double{v.z})});
}

// Two consecutive steps decide it, or the first one: are the detection states those at the beginning of the step?
// Bodies that do not move decide nothing.
bool looked_before_moving(const core::TraceReader& trace) {
  constexpr std::uint32_t kBoth = bit(Group::kBodies) | bit(Group::kDetection);
  const auto& steps = trace.steps();
  if ((trace.header().groups & kBoth) != kBoth || steps.empty()) return false;
  std::uint64_t at = steps.front() == 1 ? 0 : 1;
  while (at > 0 && at < steps.size() && steps[at] != steps[at - 1] + 1) ++at;
  if (at >= steps.size()) return false;
  std::vector<core::Vec3> began;
  for (const core::Body& body : trace.header().scene.bodies) began.push_back(body.position);
  if (at > 0) {
    auto before = trace.read(at - 1, bit(Group::kBodies));
    if (!before) return false;  // the comparison reads it again and reports why not
    began = std::move(before).value().position;
  }
  const auto frame = trace.read(at, kBoth);
  if (!frame) return false;
  bool has_moved = false;
  for (std::size_t i = 0; i < began.size(); ++i) {
    if (!(frame.value().detected_position[i] == began[i])) return false;
    has_moved |= !(frame.value().position[i] == began[i]);
  }
  return has_moved;
}

}  // namespace

bool PairRule::passes(const core::FrameDifference& d) {
  if (d.kind == core::DifferenceKind::kOrder) return true;  // a set has none
  const bool is_extra = d.kind == core::DifferenceKind::kOnlyInA && !is_exact_;
  if (is_extra) ++extra_;
  return is_extra;
}

SeparationRule::SeparationRule(const core::Scene& scene) {
  std::vector<double> of_mesh;
  for (const auto& mesh : scene.meshes) {
    double reach = 0.0;
    // A turned vertex keeps its length.
    for (const core::Vec3 v : mesh->vertices)
      reach = std::max(reach, std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z));
    of_mesh.push_back(reach);
  }
  for (const core::Body& body : scene.bodies) reach_m_.push_back(of_mesh[body.mesh]);
}

void SeparationRule::enter(const core::FrameRecord& a, const core::FrameRecord& b) {
  a_ = &a;
  b_ = &b;
  judged_ += a.separations.size();
}

bool SeparationRule::passes(const core::FrameDifference& d) {
  const bool is_distance = d.field == "/trace/narrow/distance";
  if (!is_distance && d.field != "/trace/narrow/touching")
    return d.field.starts_with("/trace/narrow/") && d.field != "/trace/narrow/pairs";
  const core::Separation& p = a_->separations[d.record];
  const core::Separation& q = b_->separations[d.record];
  double far = 0.0;
  for (const std::uint32_t body : d.bodies) far += largest(a_->detected_position[body]) + reach_m_[body];
  const double limit = kTwoEngines * kDiagonal * rounding(1) * far;
  const bool is_overlap = p.distance_m <= limit || q.distance_m <= limit;
  if (!is_distance) return std::min(std::abs(p.distance_m), std::abs(q.distance_m)) <= limit;
  if (is_overlap)
    return std::min(p.distance_m, q.distance_m) <= limit && std::max(p.distance_m, q.distance_m) <= 2.0 * limit;
  return std::abs(p.distance_m - q.distance_m) <= limit;
}

FlightRule::FlightRule(const core::TraceReader& recorded, const core::TraceReader& replayed)
    : recorded_(recorded), replayed_(replayed), scene_(recorded.header().scene) {
  const std::size_t n = scene_.bodies.size();
  velocity_bound_m_s_.assign(n, 0.0);
  position_bound_m_.assign(n, 0.0);
  is_touched_.assign(n, 0);
  was_touched_before_.assign(n, 0);
  has_margin_ = recorded.header().broad_margin_m != 0.0;
  detects_first_ = looked_before_moving(recorded);
  is_one_moment_ = looked_before_moving(replayed) == detects_first_;
}

// Adds one step's rounding. The magnitudes are those of our own frames, which agree with the recorder's to a few ulps
// while a body flies freely.
void FlightRule::advance(const core::FrameRecord& ours) {
  const double dt = scene_.dt_s;
  const double pull = dt * largest(scene_.gravity_m_s2);
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    if (!(scene_.bodies[i].inverse_mass > 0.0F) || is_touched_[i] != 0) continue;
    const double v = largest(ours.detected_velocity[i]);
    const double x = largest(ours.detected_position[i]);
    velocity_bound_m_s_[i] +=
        kTwoEngines * (rounding(1) * v + 2.0 * kSubnormal) + (rounding(kOurPull) + rounding(kTheirPull)) * pull;
    position_bound_m_[i] += kTwoEngines * (rounding(1) * (x + dt * v) + 2.0 * kSubnormal) + dt * velocity_bound_m_s_[i];
  }
}

void FlightRule::touch(std::uint32_t body, std::uint64_t step) {
  if (core::is_face(body) || is_touched_[body] != 0) return;
  is_touched_[body] = 1;
  ++touched_count_;
  if (first_touch_ == 0) first_touch_ = step;
}

void FlightRule::note_contacts(const core::FrameRecord& frame, bool has_contacts) {
  if (has_contacts) {
    for (const core::Contact& c : frame.contacts) touch(c.a, frame.step), touch(c.b, frame.step);
  } else {
    for (const core::Pair p : frame.pairs) touch(p.i, frame.step), touch(p.j, frame.step);
  }
}

void FlightRule::enter(const core::FrameRecord& a, const core::FrameRecord& /*b*/) {
  const auto& steps = replayed_.steps();
  const bool has_contacts = (recorded_.header().groups & bit(Group::kContacts)) != 0;
  for (; next_ < steps.size() && steps[next_] <= a.step; ++next_) {
    was_touched_before_ = is_touched_;
    auto ours =
        replayed_.read(next_, bit(Group::kDetection) | bit(Group::kContacts) | (has_contacts ? 0 : bit(Group::kPairs)));
    if (!ours) {
      error_ = ours.error().line();
      return;
    }
    advance(ours.value());
    note_contacts(ours.value(), true);
    if (!has_contacts) note_contacts(ours.value(), false);
  }
  const auto& recorded_steps = recorded_.steps();
  const auto at = std::lower_bound(recorded_steps.begin(), recorded_steps.end(), a.step);
  auto theirs = recorded_.read(static_cast<std::uint64_t>(at - recorded_steps.begin()),
                               bit(has_contacts ? Group::kContacts : Group::kPairs));
  if (!theirs) {
    error_ = theirs.error().line();
    return;
  }
  note_contacts(theirs.value(), has_contacts);
  for (const std::uint8_t touched : is_touched_) judged_ += touched == 0 ? 1 : 0;
}

bool FlightRule::passes(const core::FrameDifference& d) {
  if (d.body_count != 1 || d.kind != core::DifferenceKind::kValue) return false;
  const std::uint32_t body = d.bodies[0];
  const bool is_detection = d.field.starts_with("/trace/detection/");
  if ((is_detection ? was_touched_before_ : is_touched_)[body] != 0) return true;
  const double off = std::abs(d.a.value() - d.b.value());
  if (d.field.ends_with("/velocity")) return off <= velocity_bound_m_s_[body];
  if (d.field.ends_with("/position")) return off <= position_bound_m_[body];
  // A bound is a position plus a number from the mesh, so each engine makes one more addition.
  if (d.field.ends_with("/boxes"))
    return has_margin_ || off <= position_bound_m_[body] + kTwoEngines * rounding(1) * std::abs(d.a.value());
  return off == 0.0;
}

}  // namespace broadside::bench
