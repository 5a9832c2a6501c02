#include "bench/forensics/flight_rule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"

namespace broadside::bench {
namespace {

using core::bit;
using core::Group;
using validation::rounding;

// Whether the detection states are those at the beginning of a step in which some body moved. Decided by the first
// step, or else by the first two consecutive steps of the trace. Where no body moves, nothing can be decided: false.
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

// When the engine looked for contacts: at the "start" of the step, or at its "end", with the pose of a free body after
// it was moved. An engine that is not the method's may declare another moment; then this is the word that it declares.
std::string_view moment_of(const core::TraceReader& trace) {
  const core::Declaration& declared = trace.header().declaration;
  if (looked_before_moving(trace)) return "start";
  if (!declared.declares("detection_at") || declared.follows_method()) return "end";
  return declared.text("detection_at");
}

bool has(const core::TraceReader& trace, Group group) {
  return (trace.header().groups & bit(group)) != 0;
}

}  // namespace

FlightRule::FlightRule(const core::TraceReader& recorded, const core::TraceReader& replayed)
    : recorded_(recorded),
      replayed_(replayed),
      scene_(recorded.header().scene),
      are_wide_(has(recorded, Group::kWideBodies) && has(replayed, Group::kWideBodies)),
      is_turning_(scene_.motion == core::Motion::kRigid),
      has_margin_(is_turning_ || recorded.header().broad_margin_m != 0.0 || replayed.header().broad_margin_m != 0.0),
      one_clips_(recorded.header().declaration.follows_method() != replayed.header().declaration.follows_method()),
      recorded_moment_(moment_of(recorded)),
      replayed_moment_(moment_of(replayed)),
      bounds_(recorded.header(), replayed.header()),
      touches_(scene_.bodies.size()),
      motions_(replayed.header()),
      has_outgrown_(scene_.bodies.size()) {
  // A spring's pull is not constant, so no bound is derived for its body.
  for (const core::Spring& spring : scene_.springs) touches_.touch(spring.body, 1);
}

std::uint32_t FlightRule::groups() const {
  return bit(are_wide_ ? Group::kWideBodies : Group::kBodies) | (is_one_moment() ? bit(Group::kDetection) : 0U);
}

void FlightRule::note_clipped(const validation::Motion& motion) {
  for (std::uint32_t i = 0; i < motion.bodies.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (std::abs(motion.bodies[i].before.v[k] + motion.h * motion.gravity[k]) >= scene_.parameters.v_max_m_s)
        touches_.touch(i, motion.step);
}

void FlightRule::advance(const validation::Motion& motion) {
  if (one_clips_) note_clipped(motion);
  for (std::uint32_t i = 0; i < motion.bodies.size(); ++i) {
    if (touches_.is_touched(i)) continue;
    bounds_.advance(i, motion.bodies[i].before, motion.bodies[i].after);
    if (!is_turning_ || has_outgrown_[i] != 0 || !bounds_.has_outgrown(i)) continue;
    has_outgrown_[i] = 1;
    ++outgrown_count_;
    if (first_outgrown_ == 0) first_outgrown_ = motion.step;
  }
}

// Reads our own frames up to this step; the replay has a frame for every step.
core::Status FlightRule::advance_to(const core::FrameRecord& recorded) {
  const std::uint32_t ours = replayed_.header().groups;
  const std::uint32_t theirs = Touches::groups_read(recorded_.header().groups);
  const std::uint32_t read_groups =
      bit(Group::kBodies) | ((bit(Group::kWideBodies) | theirs | Touches::groups_read(ours)) & ours);
  const auto& steps = replayed_.steps();
  for (; next_ < steps.size() && steps[next_] <= recorded.step; ++next_) {
    touches_.begin_step();
    auto read = replayed_.read(next_, read_groups);
    if (!read) return read.error();
    core::FrameRecord frame = std::move(read).value();
    const validation::Motion* motion = motions_.read(frame, ours_before_ ? &*ours_before_ : nullptr);
    if (motion != nullptr) advance(*motion);
    touches_.note(frame, ours, motion);
    // A recorder may have touched bodies in steps that it left out, or record no contacts at all. Then only bodies that
    // are alone in our own run stay in the comparison.
    const bool is_told = theirs != 0 && frame.step == recorded.step;
    if (!is_told) touches_.note(frame, 0, motion);
    if (theirs == bit(Group::kPairs)) touches_.note(frame, ours & theirs, nullptr);
    ours_before_ = std::move(frame);
  }
  return core::Done{};
}

void FlightRule::enter(const core::FrameRecord& a, const core::FrameRecord& b) {
  a_ = &a;
  b_ = &b;
  if (core::Status s = advance_to(a); !s) {
    error_ = s.error().line();
    return;
  }
  const std::uint32_t groups = recorded_.header().groups;
  const auto& steps = recorded_.steps();
  const auto at = std::lower_bound(steps.begin(), steps.end(), a.step) - steps.begin();
  auto theirs = recorded_.read(static_cast<std::uint64_t>(at), Touches::groups_read(groups));
  if (!theirs) {
    error_ = theirs.error().line();
    return;
  }
  touches_.note(theirs.value(), groups, nullptr);
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) judged_ += touches_.is_touched(i) ? 0 : 1;
}

// The allowance for rounding where one trace holds a number in float64 and the other in float32.
double FlightRule::narrowed(double value) const {
  const bool is_mixed = has(recorded_, Group::kWideBodies) != has(replayed_, Group::kWideBodies);
  return is_mixed ? 2.0 * rounding(1) * std::abs(value) : 0.0;
}

bool FlightRule::orientations_agree(std::uint32_t body) const {
  if (has_outgrown_[body] != 0) return true;
  using validation::to_quatd;
  const auto p = are_wide_ ? to_quatd(a_->wide.orientation[body]) : to_quatd(a_->orientation[body]);
  const auto q = are_wide_ ? to_quatd(b_->wide.orientation[body]) : to_quatd(b_->orientation[body]);
  const double apart = validation::angle_of(validation::conjugate(p) * q);
  // Each of the two quaternions has four rounded components; the angle moves by twice as much as they do.
  return apart <= bounds_.of(body).angle_rad + (are_wide_ ? 0.0 : 2.0 * rounding(8));
}

bool FlightRule::passes(const core::FrameDifference& d) {
  if (d.body_count != 1 || d.kind != core::DifferenceKind::kValue) return false;
  const std::uint32_t body = d.bodies[0];
  const bool is_detection = d.field.starts_with("/trace/detection/");
  if (is_detection ? touches_.was_touched_before(body) : touches_.is_touched(body)) return true;
  const FlightBound& bound = bounds_.of(body);
  const double off = std::abs(d.a.value() - d.b.value());
  if (d.field.ends_with("/velocity")) return off <= bound.velocity_m_s + narrowed(d.a.value());
  if (d.field.ends_with("/position")) {
    const double arm = validation::length(bounds_.facts(body).center_of_mass);
    return off <= bound.position_m + arm * std::min(2.0, bound.angle_rad) + narrowed(d.a.value());
  }
  // A bound of a box is a position plus a number from the mesh, so each engine rounds one more addition.
  if (d.field.ends_with("/boxes"))
    return has_margin_ || off <= bound.position_m + 2.0 * rounding(1) * std::abs(d.a.value());
  if (!is_turning_) return off <= narrowed(1.0);  // numbers of a unit quaternion
  if (d.field.ends_with("/angular_velocity"))
    return has_outgrown_[body] != 0 || off <= bound.spin_rad_s + narrowed(d.a.value());
  return d.field.ends_with("/orientation") && orientations_agree(body);
}

}  // namespace broadside::bench
