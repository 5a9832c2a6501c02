#include "validation/contact_normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "core/scene/shapes.hpp"
#include "validation/application.hpp"
#include "validation/rounding.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

struct Overlap {
  std::array<double, 3> depth;
  std::array<double, 3> between;           // center of A minus center of B
  std::array<double, 3> between_rounding;  // bound of its error as the engine computes it
};

Overlap overlap_of(const core::Box& a, const core::Box& b) {
  Overlap o{};
  for (int k = 0; k < 3; ++k) {
    const double a_low = a.min[k];
    const double a_high = a.max[k];
    const double b_low = b.min[k];
    const double b_high = b.max[k];
    o.depth[k] = std::min(a_high, b_high) - std::max(a_low, b_low);
    o.between[k] = 0.5 * (a_low + a_high) - 0.5 * (b_low + b_high);
    // Each center is one rounded sum, halved exactly. Equal bounds round to equal centers.
    if (a_low == b_low && a_high == b_high) continue;
    o.between_rounding[k] = rounding(1) * 0.5 * (std::abs(a_low + a_high) + std::abs(b_low + b_high)) + kSubnormal;
  }
  return o;
}

class ContactNormal final : public Validator {
 public:
  explicit ContactNormal(const Subject& subject)
      : scene_(subject.header.scene),
        epsilon_m_(scene_.parameters.epsilon_m),
        is_colored_(setting(subject.header.stamp, "solver") == "colored" &&
                    setting(subject.header.stamp, "variant") != "printed-E8"),
        bodies_(scene_) {
    const core::ShapeTable table = core::build_shapes(scene_);
    for (const std::uint32_t shape : table.shape_of_body) local_.push_back(table.shapes[shape].octree.boxes[0]);
  }

  void look(const Evidence& evidence) override {
    step_ = evidence.frame.step;
    order_.clear();
    last_rank_ = 0;
    for (const core::Contact& contact : evidence.frame.contacts) {
      if (!bodies_.application(contact) || core::is_face(contact.a)) continue;
      judge_order(contact);
      const int axis = judge_form(contact);
      if (axis < 0) continue;
      if (core::is_face(contact.b))
        judge_face(contact, axis);
      else
        judge_pair(contact, axis);
    }
  }

  core::Verdict conclude() override {
    return tally_.conclude(
        "no contacts", std::to_string(pairs_) + " contacts of two bodies, " + std::to_string(faces_) + " with faces");
  }

 private:
  [[nodiscard]] Where at(const core::Contact& c, std::string_view field) const {
    return Where::pair(step_, c.a, c.b, field);
  }

  // Checks that the normal has unit length and lies along an axis. Returns that axis, or -1.
  int judge_form(const core::Contact& c) {
    const Vec3d n(c.normal);
    const bool is_unit =
        tally_.check(std::abs(dot(n, n) - 1.0), {0.0, "", "METHOD 4: a unit vector of an axis has components 0 and 1"},
                     at(c, "contact.normal"));
    if (!is_unit) return -1;
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
    const double off = std::sqrt(std::max(0.0, dot(n, n) - n[axis] * n[axis]));
    const bool is_axis = tally_.check(off, {0.0, "rad", "METHOD 4: the normal is a unit vector of an axis, exactly"},
                                      at(c, "contact.normal"));
    return is_axis ? axis : -1;
  }

  void judge_pair(const core::Contact& c, int axis) {
    ++pairs_;
    const Overlap o = overlap_of(core::translated(local_[c.a], c.pre_a.x), core::translated(local_[c.b], c.pre_b.x));
    const double sign = Vec3d(c.normal)[axis];
    const double least = std::min({o.depth[0], o.depth[1], o.depth[2]});
    tally_.require(least > 0.0, "METHOD 4: no contact unless the boxes overlap on every axis", at(c, "contact.depth"));
    judge_depth(c, o.depth[axis]);

    // Within its own error, rounding decides which side of epsilon a distance is on.
    const double apart =
        std::sqrt(o.between[0] * o.between[0] + o.between[1] * o.between[1] + o.between[2] * o.between[2]);
    const double error = o.between_rounding[0] + o.between_rounding[1] + o.between_rounding[2] + rounding(3) * apart +
                         rounding(1) * epsilon_m_ + std::sqrt(4.0 * kSubnormal);
    const bool may_coincide = apart < epsilon_m_ + error;
    if (may_coincide && axis == 0 && sign > 0.0) {
      tally_.require(true, "METHOD 4: where centers are nearer than epsilon, the normal is +x",
                     at(c, "contact.normal"));
      return;
    }
    if (apart < epsilon_m_ - error) {
      tally_.require(false, "METHOD 4: where centers are nearer than epsilon, the normal is +x",
                     at(c, "contact.normal"));
      return;
    }
    judge_axis(c, o, axis, least);
    const double toward_a = sign * o.between[axis];
    if (std::abs(o.between[axis]) > o.between_rounding[axis])
      tally_.check(-toward_a,
                   {o.between_rounding[axis], "m", "the sign is that of the centers' difference, from B to A"},
                   at(c, "contact.normal"));
  }

  void judge_axis(const core::Contact& c, const Overlap& o, int axis, double least) {
    tally_.check(
        o.depth[axis] - least,
        {rounding(2) * std::abs(least), "m", "METHOD 4: the axis of least overlap, two subtractions (float32)"},
        at(c, "contact.normal"));
    // The tie rule, on the depths as floats.
    for (int k = 0; k < axis; ++k)
      tally_.require(static_cast<float>(o.depth[k]) != static_cast<float>(o.depth[axis]),
                     "METHOD 4: where overlaps are equal, the normal is along the lowest axis",
                     at(c, "contact.normal"));
  }

  void judge_face(const core::Contact& c, int axis) {
    ++faces_;
    const std::uint32_t face = c.b - core::kFirstFace;
    const bool is_upper = (face & 1U) != 0;
    const int face_axis = static_cast<int>(face >> 1U);
    const double inward = is_upper ? -1.0 : 1.0;
    tally_.require(axis == face_axis && Vec3d(c.normal)[axis] == inward, "METHOD 4: a face's normal points inward",
                   at(c, "contact.normal"));
    const core::Box box = core::translated(local_[c.a], c.pre_a.x);
    const double overshoot = is_upper ? static_cast<double>(box.max[face_axis]) - scene_.domain.max[face_axis]
                                      : static_cast<double>(scene_.domain.min[face_axis]) - box.min[face_axis];
    judge_depth(c, overshoot);
    tally_.require(c.color == core::kFaceColor, "SCHEMA.md: faces come after all colors, and have color 0xFFFFFFFF",
                   at(c, "contact.color"));
    tally_.require(c.pre_b == core::Kinematics{} && c.post_b == core::Kinematics{},
                   "SCHEMA.md: a face has neither position nor velocity, before and after", at(c, "contact.b"));
  }

  void judge_depth(const core::Contact& c, double expected) {
    tally_.check(std::abs(c.depth_m - expected),
                 {rounding(1) * std::abs(expected) + kSubnormal, "m", "P(9): one subtraction of box bounds (float32)"},
                 at(c, "contact.depth"));
    tally_.require(c.depth_m > 0.0F, "METHOD 4: a contact has positive depth", at(c, "contact.depth"));
  }

  // The list is ordered by color, with the faces last. For each body, face indices rise; with the colored solver colors
  // rise, and no dynamic body occurs twice in one color.
  void judge_order(const core::Contact& c) {
    const std::int64_t in_list = core::is_face(c.b) ? std::int64_t{core::kFaceColor} : (is_colored_ ? c.color : 0);
    tally_.require(in_list >= last_rank_,
                   "SCHEMA.md: contacts are in the order of colors, the faces of the domain last",
                   at(c, "contact.order"));
    last_rank_ = in_list;
    for (const std::uint32_t body : {c.a, c.b}) {
      if (core::is_face(body) || !(bodies_.inverse_mass(body) > 0.0)) continue;
      const std::int64_t rank = core::is_face(c.b) ? std::int64_t{c.b} : (is_colored_ ? std::int64_t{c.color} : 0);
      const auto [entry, is_first] = order_.try_emplace(body, rank);
      if (is_first) continue;
      const bool must_rise = is_colored_ || core::is_face(c.b);
      tally_.require(must_rise ? rank > entry->second : rank >= entry->second,
                     "METHOD 4: pairs color by color, then faces -x +x -y +y -z +z; one application a color and body",
                     at(c, "contact.order"));
      entry->second = rank;
    }
  }

  const core::Scene& scene_;
  double epsilon_m_;
  bool is_colored_;
  ContactBodies bodies_;
  std::vector<core::Box> local_;
  std::unordered_map<std::uint32_t, std::int64_t> order_;
  std::int64_t last_rank_ = 0;
  std::uint64_t step_ = 0;
  Tally tally_{"contact-normal", "properties of contacts", "METHOD 4: the axis of least overlap, from B to A"};
  std::uint64_t pairs_ = 0;
  std::uint64_t faces_ = 0;
};

std::string why_not_contact_normal(const Subject& subject) {
  if (std::string text = lacking(subject.header, core::bit(core::Group::kContacts)); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow contact_normal_row() {
  return {
      "contact-normal",
      "normals are unit vectors of the axis of least overlap, lowest on ties, from B to A; depth is that overlap",
      "a flipped sign; a non-minimal axis; a normal that is no unit vector",
      core::bit(core::Group::kContacts),
      0,
      why_not_contact_normal,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<ContactNormal>(subject); }};
}

}  // namespace broadside::validation
