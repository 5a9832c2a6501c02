#include "validation/hand_over.hpp"

#include <algorithm>

#include "validation/rounding.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kChain = "each contact starts from exactly the state that the body's previous contact left";
constexpr std::string_view kSums =
    "jacobi: contacts of two bodies start from the states at detection; their n changes are added, n + 2 "
    "operations (float32)";
constexpr std::string_view kOutside = "outside a face without a contact with it: u |bound| (METHOD 4, float32)";

}  // namespace

HandOver::HandOver(const core::TraceHeader& header, const ContactBodies& bodies, const std::vector<core::Box>& local,
                   bool is_summed)
    : scene_(header.scene),
      bodies_(bodies),
      local_(local),
      is_summed_(is_summed),
      chain_(is_summed ? kSums : kChain),
      hand_over_("hand-over", "states between contacts", chain_),
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
  stand_.clear();
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i)
    stand_.push_back({Vec3d(frame.detected_position[i]), Vec3d(frame.detected_velocity[i])});
  if (is_summed_) add_up(frame);
  for (const core::Contact& c : frame.contacts) {
    if (!bodies_.application(c) || (is_summed_ && !core::is_face(c.b))) continue;
    link(c.pre_a, c.post_a, c.a);
    if (!core::is_face(c.b)) link(c.pre_b, c.post_b, c.b);
  }
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) judge_end(frame, i);
}

void HandOver::judge_end(const core::FrameRecord& frame, std::uint32_t body) {
  // Whether a static body may move at all is checked by center-of-mass.
  if (!(scene_.bodies[body].inverse_mass > 0.0F)) {
    hand_over_.check(largest_component(Vec3d(frame.velocity[body]) - Vec3d(frame.detected_velocity[body])),
                     {0.0, "m/s", kChain}, Where::body(step_, body, "bodies.velocity"));
    return;
  }
  const double v_max = scene_.parameters.v_max_m_s;
  const Stand& last = stand_[body];
  const Vec3d clipped{std::clamp(last.v.x, -v_max, v_max), std::clamp(last.v.y, -v_max, v_max),
                      std::clamp(last.v.z, -v_max, v_max)};
  hand_over_.check(largest_component(Vec3d(frame.position[body]) - last.x), {last.x_error_m, "m", chain_},
                   Where::body(step_, body, "bodies.position"));
  hand_over_.check(largest_component(Vec3d(frame.velocity[body]) - clipped), {last.v_error_m_s, "m/s", chain_},
                   Where::body(step_, body, "bodies.velocity"));
}

// A static body too starts each contact where it stands; whether it may move is checked by center-of-mass.
void HandOver::link(const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body) {
  Stand& stand = stand_[body];
  hand_over_.check(largest_component(Vec3d(pre.x) - stand.x), {stand.x_error_m, "m", chain_},
                   Where::body(step_, body, "contact.pre"));
  hand_over_.check(largest_component(Vec3d(pre.v) - stand.v), {stand.v_error_m_s, "m/s", chain_},
                   Where::body(step_, body, "contact.pre"));
  stand = {Vec3d(post.x), Vec3d(post.v)};
}

// Rounding of a sum of n changes: one subtraction each, n - 1 additions on at most the sum of their magnitudes, and one
// addition to the state.
void HandOver::add_up(const core::FrameRecord& frame) {
  std::vector<Stand> sums(stand_.size());
  std::vector<int> counts(stand_.size(), 0);
  const auto add = [&](const core::Kinematics& pre, const core::Kinematics& post, std::uint32_t body) {
    hand_over_.require(pre == core::Kinematics{frame.detected_position[body], frame.detected_velocity[body]}, kSums,
                       Where::body(step_, body, "contact.pre"));
    const Vec3d moved = Vec3d(post.x) - Vec3d(pre.x);
    const Vec3d gained = Vec3d(post.v) - Vec3d(pre.v);
    sums[body].x = sums[body].x + moved;
    sums[body].v = sums[body].v + gained;
    sums[body].x_error_m += largest_component(moved);
    sums[body].v_error_m_s += largest_component(gained);
    ++counts[body];
  };
  for (const core::Contact& c : frame.contacts) {
    if (core::is_face(c.b) || !bodies_.application(c)) continue;
    add(c.pre_a, c.post_a, c.a);
    add(c.pre_b, c.post_b, c.b);
  }
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
    if (counts[i] == 0 || !(scene_.bodies[i].inverse_mass > 0.0F)) continue;
    Stand& stand = stand_[i];
    stand.x = stand.x + sums[i].x;
    stand.v = stand.v + sums[i].v;
    stand.x_error_m =
        rounding(counts[i] + 1) * sums[i].x_error_m + rounding(1) * largest_component(stand.x) + kSubnormal;
    stand.v_error_m_s =
        rounding(counts[i] + 1) * sums[i].v_error_m_s + rounding(1) * largest_component(stand.v) + kSubnormal;
  }
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
  // Where the domain is narrower than the body, the opposite face, later in the order, may have pushed it out of this
  // one.
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
