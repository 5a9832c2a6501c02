#include "core/method/rigid/step_in_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/contact.hpp"
#include "core/method/frame_digest.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/point_digest.hpp"
#include "core/method/rigid/turned_box.hpp"

namespace broadside::core {
namespace {

std::uint64_t digest_of_step(const FrameRecord& frame) {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < frame.position.size(); ++i)
    sum += body_digest(i, frame.position[i], frame.orientation[i], frame.velocity[i], frame.angular_velocity[i]);
  for (const Pair pair : frame.confirmed) sum += confirmed_digest(pair);
  for (const ContactPoint& point : frame.points) sum += point_digest(point);
  return sum;
}

// Where a point of the body's surface was at the start of the step.
Vec3 at_start(const FrameRecord& part, const FrameRecord& first, std::uint32_t body, Vec3 point) {
  if (is_face(body)) return point;
  const Vec3 in_body = turned_back(turned_axes(part.detected_orientation[body]), point - part.detected_position[body]);
  return first.detected_position[body] + turned(turned_axes(first.detected_orientation[body]), in_body);
}

// All points of a frame belong to its pose of detection, so each point is placed where its two surfaces were at the
// start of the step: along the normal in the middle between them, across the normal nearer to the surface that has
// moved less since. Then the moment of the impulse on a body that was still at rest is right. Before, the point of a
// blow from the side by a fast body was recorded 25 mm beside the corner that was struck.
ContactPoint taken_back(ContactPoint p, const FrameRecord& part, const FrameRecord& first) {
  const Vec3 half = (0.5F * p.gap_m) * p.normal;
  const Vec3 on_a = at_start(part, first, p.a, p.point + half);
  const Vec3 on_b = at_start(part, first, p.b, p.point - half);
  const float way_a_m = length(p.point + half - on_a);
  const float way_b_m = length(p.point - half - on_b);
  p.gap_m = dot(p.normal, on_a - on_b);
  const Vec3 across = (on_b - on_a) + p.gap_m * p.normal;
  // The point on a plane is where the body is, wherever the body slides.
  const float share = is_face(p.b) || !(way_a_m > 0.0F) ? 0.0F : way_a_m / (way_a_m + way_b_m);
  p.point = (on_a - (0.5F * p.gap_m) * p.normal) + share * across;
  return p;
}

void add_points_of(const FrameRecord& part, const FrameRecord& first, std::vector<ContactPoint>& points) {
  if (&part == &first)
    points.insert(points.end(), part.points.begin(), part.points.end());
  else
    for (const ContactPoint& p : part.points) points.push_back(taken_back(p, part, first));
}

bool is_before(const ContactPoint& p, const ContactPoint& q) {
  return p.a != q.a ? p.a < q.a : p.b < q.b;
}

// Along the normals of later parts, bodies may seem deeper at the start than they are. So no point is deeper than the
// deepest one of its pair that was found at the start.
void keep_depths_of(const FrameRecord& first, std::vector<ContactPoint>& points) {
  auto found = first.points.begin();
  for (auto p = points.begin(); p != points.end();) {
    float least_m = 0.0F;
    while (found != first.points.end() && is_before(*found, *p)) ++found;
    for (; found != first.points.end() && !is_before(*p, *found); ++found) least_m = std::min(least_m, found->gap_m);
    const ContactPoint pair = *p;
    for (; p != points.end() && !is_before(pair, *p); ++p) p->gap_m = std::max(p->gap_m, least_m);
  }
}

}  // namespace

float largest_mass_ratio(const Scene& scene) {
  float least = 0.0F;
  float most = 0.0F;
  for (const Body& body : scene.bodies) {
    if (!(body.inverse_mass > 0.0F)) continue;
    least = least > 0.0F ? std::min(least, body.inverse_mass) : body.inverse_mass;
    most = std::max(most, body.inverse_mass);
  }
  return mass_ratio(least, most);
}

void StepInParts::join(FrameRecord& last, RecordLevel level) const {
  if (!earlier_.empty()) {
    std::vector<ContactPoint> points;
    const FrameRecord& first = earlier_.front();
    for (const FrameRecord& part : earlier_) add_points_of(part, first, points);
    add_points_of(last, first, points);
    std::stable_sort(points.begin(), points.end(),
                     [](const ContactPoint& p, const ContactPoint& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
    keep_depths_of(first, points);
    last.points = std::move(points);
    for (const FrameRecord& part : earlier_)
      for (std::size_t i = 0; i < part.position.size(); ++i)
        last.part_poses.push_back({part.position[i], part.orientation[i]});
    last.detected_position = first.detected_position;
    last.detected_velocity = first.detected_velocity;
    last.detected_orientation = first.detected_orientation;
    last.boxes = first.boxes;
    last.pairs = first.pairs;
    last.pairs_demanded = first.pairs_demanded;
    last.pairs_raw = first.pairs_raw;
    last.confirmed = first.confirmed;
    last.digest = digest_of_step(last);
  }
  if (level == RecordLevel::kFull) return;
  FrameRecord told;
  told.step = last.step;
  told.time_s = last.time_s;
  told.digest = last.digest;
  last = std::move(told);
}

}  // namespace broadside::core
