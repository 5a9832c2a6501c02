#include "validation/metamorphic.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "validation/scene_relation.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

using core::Contact;
using core::FrameRecord;
using core::Group;
using core::Pair;
using core::Vec3;
using Kind = SceneRelation::Kind;

constexpr std::string_view kMetamorphicOrigin =
    "the transformed scene's outcome, to the bit: rounding is symmetric in sign and scale";

class Metamorphic final : public Validator {
 public:
  explicit Metamorphic(const Subject& subject)
      : scene_(subject.header.scene),
        baseline_(subject.baseline->stamp.label()),
        common_(subject.header.groups & subject.baseline->groups),
        relation_(*relation_of(scene_, subject.baseline->scene)) {}

  void look(const Evidence& evidence) override {
    if (evidence.baseline == nullptr || has_parted_) return;
    frame_ = &evidence.frame;
    other_ = evidence.baseline;
    step_ = frame_->step;
    if (frame_->detected_position.size() != scene_.bodies.size() ||
        other_->detected_position.size() != scene_.bodies.size())
      return;
    if (relation_.kind == Kind::kGrown) return judge_grown();
    if (!judge_detection()) return;
    ++compared_;
    if (is_common(Group::kPairs)) judge_pairs(frame_->pairs, other_->pairs, "pairs");
    if (is_common(Group::kConfirmed) && !judge_confirmed()) return;
    if (is_common(Group::kContacts)) judge_contacts();
  }

  core::Verdict conclude() override {
    std::string notes = std::to_string(compared_) + " frames compared with the scene " + relation_.text();
    if (has_parted_) notes += ", diverged in step " + std::to_string(parted_at_) + ": " + why_parted_;
    core::Verdict verdict = tally_.conclude("the two traces share no step", notes);
    verdict.baseline = baseline_;
    return verdict;
  }

 private:
  [[nodiscard]] bool is_common(Group g) const { return (common_ & core::bit(g)) != 0; }

  void part(std::string why) {
    has_parted_ = true;
    parted_at_ = step_;
    why_parted_ = std::move(why);
  }

  bool require(bool holds, const Where& where) { return tally_.require(holds, kMetamorphicOrigin, where); }

  void judge_grown() {
    if (frame_->detected_position != other_->detected_position) return part("bodies stand elsewhere");
    ++compared_;
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const core::Box& in = frame_->boxes[i];
      const core::Box& out = other_->boxes[i];
      // Only boxes that contain the body's origin grow on every side.
      for (int k = 0; k < 3; ++k)
        if (out.min[k] > in.min[k] || out.max[k] < in.max[k]) return part("a box did not grow on every side");
    }
    if (!is_common(Group::kPairs)) return;
    std::vector<Pair> lost;
    std::set_difference(frame_->pairs.begin(), frame_->pairs.end(), other_->pairs.begin(), other_->pairs.end(),
                        std::back_inserter(lost));
    require(lost.empty(), lost.empty() ? Where::frame(step_, "pairs")
                                       : Where::pair(step_, lost.front().i, lost.front().j, "pairs: lost by growing"));
  }

  // When the detection states were equal before, these follow from what happened since.
  bool judge_detection() {
    for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
      const std::uint32_t j = relation_.body(i);
      const bool same = relation_.vector(frame_->detected_position[i]) == other_->detected_position[j] &&
                        relation_.vector(frame_->detected_velocity[i]) == other_->detected_velocity[j] &&
                        relation_.box(frame_->boxes[i]) == other_->boxes[j];
      if (same) {
        tally_.require(true, kMetamorphicOrigin, Where::body(step_, i, "detection"));
        continue;
      }
      if (!why_may_part_.empty())
        part(why_may_part_);
      else {
        require(false, Where::body(step_, i, "detection"));
        part("the states differ");
      }
      return false;
    }
    return true;
  }

  [[nodiscard]] Pair mapped(Pair p) const { return core::make_pair_of(relation_.body(p.i), relation_.body(p.j)); }

  bool is_same_set(const std::vector<Pair>& mine, const std::vector<Pair>& theirs, Pair& first) const {
    std::vector<Pair> wanted;
    wanted.reserve(mine.size());
    for (const Pair p : mine) wanted.push_back(mapped(p));
    std::sort(wanted.begin(), wanted.end());
    std::vector<Pair> difference;
    std::set_symmetric_difference(wanted.begin(), wanted.end(), theirs.begin(), theirs.end(),
                                  std::back_inserter(difference));
    if (!difference.empty()) first = difference.front();
    return difference.empty();
  }

  void judge_pairs(const std::vector<Pair>& mine, const std::vector<Pair>& theirs, std::string_view field) {
    Pair first;
    const bool same = is_same_set(mine, theirs, first);
    require(same, same ? Where::frame(step_, field) : Where::pair(step_, first.i, first.j, field));
  }

  // False when nothing after it can be compared.
  bool judge_confirmed() {
    Pair first;
    const bool same = is_same_set(frame_->confirmed, other_->confirmed, first);
    if (!same && relation_.kind == Kind::kMirrored) {
      part("vertices on an octant's plane changed octants, and with them confirmed pairs");
      return false;
    }
    if (!require(same, same ? Where::frame(step_, "confirmed") : Where::pair(step_, first.i, first.j, "confirmed")))
      return true;
    if (frame_->proximity.size() != frame_->confirmed.size() || other_->proximity.size() != other_->confirmed.size())
      return true;
    for (std::size_t k = 0; k < frame_->confirmed.size(); ++k) {
      const Pair p = mapped(frame_->confirmed[k]);
      const auto at =
          std::lower_bound(other_->confirmed.begin(), other_->confirmed.end(), p) - other_->confirmed.begin();
      const float mine = relation_.length(relation_.length(frame_->proximity[k].squared_distance_m2));
      require(mine == other_->proximity[static_cast<std::size_t>(at)].squared_distance_m2,
              Where::pair(step_, frame_->confirmed[k].i, frame_->confirmed[k].j, "proximity.squared_distance"));
    }
    return true;
  }

  // The contact as the baseline should have it; its bodies may be swapped.
  [[nodiscard]] Contact mapped(const Contact& c) const {
    Contact out = c;
    const auto state = [this](const core::Kinematics& k) {
      return core::Kinematics{relation_.vector(k.x), relation_.vector(k.v)};
    };
    out.a = relation_.body(c.a);
    out.b = core::is_face(c.b) ? relation_.face(c.b) : relation_.body(c.b);
    out.depth_m = relation_.length(c.depth_m);
    out.normal = relation_.direction(c.normal);
    out.tangent = relation_.direction(c.tangent);
    out.normal_impulse_n_s = relation_.length(c.normal_impulse_n_s);
    out.tangent_impulse_n_s = relation_.length(c.tangent_impulse_n_s);
    out.pre_a = state(c.pre_a), out.post_a = state(c.post_a);
    out.pre_b = state(c.pre_b), out.post_b = state(c.post_b);
    if (core::is_face(out.b) || out.a < out.b) return out;
    std::swap(out.a, out.b), std::swap(out.pre_a, out.pre_b), std::swap(out.post_a, out.post_b);
    out.normal = {-out.normal.x, -out.normal.y, -out.normal.z};
    out.tangent = {-out.tangent.x, -out.tangent.y, -out.tangent.z};
    return out;
  }

  static bool is_same(const Contact& a, const Contact& b) {
    return a.depth_m == b.depth_m && a.normal == b.normal && a.tangent == b.tangent &&
           a.normal_impulse_n_s == b.normal_impulse_n_s && a.tangent_impulse_n_s == b.tangent_impulse_n_s &&
           a.pre_a == b.pre_a && a.pre_b == b.pre_b && a.post_a == b.post_a && a.post_b == b.post_b;
  }

  // Busy: bodies that met more than one other body, in both runs together. Applying one contact can move a body out of
  // another, which is then no contact, so two orders may have recorded different contacts. A body that met a busy one
  // may also have another state afterwards, and meets the faces in that state.
  void find_busy() {
    std::map<std::uint32_t, std::set<std::uint32_t>> partners;
    const auto meet = [&partners](std::uint32_t a, std::uint32_t b) { partners[a].insert(b), partners[b].insert(a); };
    for (const Contact& c : frame_->contacts)
      if (!core::is_face(c.b)) meet(relation_.body(c.a), relation_.body(c.b));
    for (const Contact& c : other_->contacts)
      if (!core::is_face(c.b)) meet(c.a, c.b);
    for (const auto& [body, met] : partners) {
      if (met.size() < 2) continue;
      busy_.insert(body);
      disturbed_.insert(body);
      disturbed_.insert(met.begin(), met.end());
    }
  }

  void judge_contacts() {
    busy_.clear(), disturbed_.clear();
    if (relation_.kind == Kind::kRenumbered) find_busy();
    if (!busy_.empty()) why_may_part_ = "bodies in several contacts were resolved in another order";
    std::map<std::pair<std::uint32_t, std::uint32_t>, const Contact*> theirs;
    for (const Contact& c : other_->contacts)
      if (!depends_on_order(c)) theirs[{c.a, c.b}] = &c;
    std::size_t found = 0;
    for (const Contact& c : frame_->contacts) {
      const Contact wanted = mapped(c);
      if (depends_on_order(wanted)) continue;
      const Where where = Where::pair(step_, c.a, c.b, "contact");
      const auto at = theirs.find({wanted.a, wanted.b});
      if (at != theirs.end()) ++found;
      if (has_no_side(c)) {
        why_may_part_ = "a contact's centers coincide on its axis";
        tally_.leave_undecided();
        continue;
      }
      require(at != theirs.end() && is_same(wanted, *at->second), where);
    }
    require(found == theirs.size(), Where::frame(step_, "contacts: only in the baseline"));
  }

  // Whether the order of contacts may show in this contact. Bodies as the baseline numbers them.
  [[nodiscard]] bool depends_on_order(const Contact& c) const {
    return core::is_face(c.b) ? disturbed_.contains(c.a) : busy_.contains(c.a) || busy_.contains(c.b);
  }

  // Pairs whose boxes' centers, moved with the bodies, are equal on the normal's axis.
  [[nodiscard]] bool has_no_side(const Contact& c) const {
    if (core::is_face(c.b) || relation_.kind == Kind::kScaled) return false;
    int axis = 0;
    while (axis < 2 && c.normal[axis] == 0.0F) ++axis;
    const auto center = [&](std::uint32_t body, Vec3 x) {
      const core::Box& b = frame_->boxes[body];
      const Vec3 moved = x - frame_->detected_position[body];
      return 0.5 * (static_cast<double>(b.min[axis]) + b.max[axis]) + moved[axis];
    };
    const double apart = center(c.a, c.pre_a.x) - center(c.b, c.pre_b.x);
    return std::abs(apart) <= scene_.parameters.epsilon_m;
  }

  const core::Scene& scene_;
  std::string baseline_;
  std::uint32_t common_;
  SceneRelation relation_;
  const FrameRecord* frame_ = nullptr;
  const FrameRecord* other_ = nullptr;
  std::uint64_t step_ = 0;
  std::set<std::uint32_t> busy_;  // as the baseline numbers them
  std::set<std::uint32_t> disturbed_;
  std::string why_may_part_;
  bool has_parted_ = false;
  std::uint64_t parted_at_ = 0;
  std::string why_parted_;
  std::uint64_t compared_ = 0;
  Tally tally_{"metamorphic", "states, pairs and contacts", kMetamorphicOrigin};
};

std::string why_not_metamorphic(const Subject& subject) {
  if (subject.baseline == nullptr) return "no run of a transformed scene was given";
  if (subject.header.stamp.scene_digest == subject.baseline->stamp.scene_digest)
    return "the baseline is of the same scene, not of a transformed one";
  const core::Stamp& a = subject.header.stamp;
  const core::Stamp& b = subject.baseline->stamp;
  if (!are_twins(subject.header, *subject.baseline)) return "the baseline is another engine (" + b.engine + ")";
  if (!same_settings_but(a, b, {"threads"})) return "the baseline has other settings (" + b.label() + ")";
  for (const core::TraceHeader* header : {&subject.header, subject.baseline})
    if (std::string text = lacking(*header, core::bit(Group::kDetection)); !text.empty()) return text;
  return {};
}

}  // namespace

ValidatorRow metamorphic_row() {
  constexpr std::uint32_t kRead = core::bit(Group::kDetection) | core::bit(Group::kPairs) |
                                  core::bit(Group::kConfirmed) | core::bit(Group::kContacts);
  return {"metamorphic",
          "a renumbered, mirrored or scaled scene has the renumbered, mirrored or scaled outcome; a grown one "
          "loses no pairs",
          "a result that depends on the order of ids, on a direction of space, or on the unit of length",
          kRead,
          kRead,
          why_not_metamorphic,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Metamorphic>(subject); },
          true};
}

}  // namespace broadside::validation
