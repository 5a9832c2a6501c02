#include "validation/hand_over.hpp"

#include <algorithm>

#include "validation/rounding.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kChain = "states are handed on from contact to contact unchanged";
constexpr std::string_view kOutside = "outside a face without a contact with it: u |bound| (METHOD 4, float32)";

}  // namespace

HandOver::HandOver(const core::TraceHeader& header, const ContactBodies& bodies, const std::vector<core::Box>& local)
    : scene_(header.scene),
      bodies_(bodies),
      local_(local),
      hand_over_("hand-over", "states between contacts", kChain),
      domain_("domain", "sides of bodies without a contact with the face", kOutside) {}

void HandOver::look(const core::FrameRecord& frame) {
  step_ = frame.step;
  judge_chain(frame);
  judge_domain(frame);
}

std::string HandOver::notes() const {
  if (outside_ == 0) return {};
  return std::to_string(outside_) + " times a body ended outside the domain by more than the slop, at most " +
         number_text(deepest_m_) + " m, with its face contact recorded";
}

// Each contact starts where the body's last one ended; the frame ends there too, clipped.
void HandOver::judge_chain(const core::FrameRecord& frame) {
  state_.resize(scene_.bodies.size());
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i)
    state_[i] = {frame.detected_position[i], frame.detected_velocity[i]};
  for (const core::Contact& c : frame.contacts) {
    if (!bodies_.application(c)) continue;
    link(c.pre_a, c.post_a, c.a);
    if (!core::is_face(c.b)) link(c.pre_b, c.post_b, c.b);
  }
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
    // Whether a static body may move at all is checked by center-of-mass.
    if (!(scene_.bodies[i].inverse_mass > 0.0F)) {
      hand_over_.check(largest_component(Vec3d(frame.velocity[i]) - Vec3d(frame.detected_velocity[i])),
                       {0.0, "m/s", kChain}, Where::body(step_, i, "bodies.velocity"));
      continue;
    }
    const double v_max = scene_.parameters.v_max_m_s;
    const Vec3d clipped{std::clamp<double>(state_[i].v.x, -v_max, v_max),
                        std::clamp<double>(state_[i].v.y, -v_max, v_max),
                        std::clamp<double>(state_[i].v.z, -v_max, v_max)};
    hand_over_.check(largest_component(Vec3d(frame.position[i]) - Vec3d(state_[i].x)), {0.0, "m", kChain},
                     Where::body(step_, i, "bodies.position"));
    hand_over_.check(largest_component(Vec3d(frame.velocity[i]) - clipped), {0.0, "m/s", kChain},
                     Where::body(step_, i, "bodies.velocity"));
  }
}

void HandOver::link(const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body) {
  if (!(scene_.bodies[body].inverse_mass > 0.0F)) return;
  const double off = std::max(largest_component(Vec3d(pre.x) - Vec3d(state_[body].x)),
                              largest_component(Vec3d(pre.v) - Vec3d(state_[body].v)));
  hand_over_.check(off, {0.0, "m or m/s", kChain}, Where::body(step_, body, "contact.pre"));
  state_[body] = post;
}

void HandOver::judge_domain(const core::FrameRecord& frame) {
  met_.assign(scene_.bodies.size(), 0);
  for (const core::Contact& c : frame.contacts)
    if (core::is_face(c.b) && bodies_.application(c)) met_[c.a] |= 1U << (c.b - core::kFirstFace);
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
    if (!(scene_.bodies[i].inverse_mass > 0.0F)) continue;
    for (std::uint32_t face = 0; face < static_cast<std::uint32_t>(core::kFaceCount); ++face)
      judge_face(frame.position[i], i, face);
  }
}

void HandOver::judge_face(core::Vec3 x, std::uint32_t body, std::uint32_t face) {
  const int axis = static_cast<int>(face >> 1U);
  const bool is_upper = (face & 1U) != 0;
  const double local = is_upper ? local_[body].max[axis] : local_[body].min[axis];
  const double wall = is_upper ? scene_.domain.max[axis] : scene_.domain.min[axis];
  const double bound = local + x[axis];
  const double outside = is_upper ? bound - wall : wall - bound;
  const double error = rounding(1) * std::abs(bound);
  // A body pushed in by the opposite face, later in the order, may stick out here when the domain is narrower.
  const bool is_met = (met_[body] & (1U << face | 1U << (face ^ 1U))) != 0;
  if (!is_met) {
    domain_.check(outside, {error, "m", kOutside},
                  Where::pair(step_, body, core::kFirstFace + face, "bodies.position"));
    return;
  }
  if (outside > scene_.parameters.delta_m + error) {
    ++outside_;
    deepest_m_ = std::max(deepest_m_, outside);
  }
}

}  // namespace broadside::validation
