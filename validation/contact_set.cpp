#include "validation/contact_set.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/scene/shapes.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

using core::Box;
using core::Contact;
using core::FrameRecord;
using core::Pair;
using core::Vec3;

constexpr std::string_view kContactSetOrigin =
    "METHOD 3 and 4: one contact for each pair that touches, float comparison";
constexpr std::string_view kFaceOrigin = "METHOD 4: one contact for each face that a body's box passes";
constexpr std::uint32_t kPairGroups = core::bit(core::Group::kConfirmed) | core::bit(core::Group::kDetection);

// When the engine may have tested the boxes of a contact that is not in the trace.
enum class Turn { kAnyMoment, kAnyColor, kDetection, kUnknown };

Turn turn_of(const core::Stamp& stamp) {
  const std::string_view solver = setting(stamp, "solver");
  if (solver == "printed-E8" || setting(stamp, "variant") == "printed-E8") return Turn::kUnknown;
  if (solver == "jacobi") return Turn::kDetection;
  return solver == "colored" ? Turn::kAnyColor : Turn::kAnyMoment;
}

class ContactSet final : public Validator {
 public:
  explicit ContactSet(const Subject& subject)
      : header_(subject.header),
        scene_(header_.scene),
        turn_(turn_of(header_.stamp)),
        has_pairs_(lacking(header_, kPairGroups).empty()),
        has_vertices_(setting(header_.stamp, "vertex_stage") == "on") {
    const core::ShapeTable table = core::build_shapes(scene_);
    for (const std::uint32_t shape : table.shape_of_body) local_.push_back(table.shapes[shape].octree.boxes[0]);
  }

  void look(const Evidence& evidence) override {
    frame_ = &evidence.frame;
    collect_applied();
    if (has_pairs_ && frame_->detected_position.size() == local_.size()) judge_pairs();
    judge_faces();
  }

  core::Verdict conclude() override {
    std::string notes = std::to_string(pairs_) + " contacts of two bodies, " + std::to_string(faces_) + " with faces";
    if (parted_ > 0)
      notes += ", " + std::to_string(parted_) + " touching pairs had separated before their contact was applied";
    return tally_.conclude("no contacts, and no body touches anything", notes);
  }

 private:
  // Contacts of two bodies as pairs in order, and for each body its contacts with faces in the order -x to +z.
  void collect_applied() {
    applied_.clear();
    at_face_.clear();
    for (std::uint32_t k = 0; k < frame_->contacts.size(); ++k) {
      const Contact& c = frame_->contacts[k];
      if (c.a >= local_.size()) continue;
      if (core::is_face(c.b))
        at_face_.push_back({c.a, c.b, k});
      else if (c.b < local_.size())
        applied_.push_back({c.a, c.b});
    }
    std::sort(applied_.begin(), applied_.end());
    std::sort(at_face_.begin(), at_face_.end());
    pairs_ += applied_.size();
    faces_ += at_face_.size();
  }

  // The confirmed pairs that touch; false when the trace does not say.
  bool collect_touching() {
    touching_.clear();
    const bool is_measured = frame_->proximity.size() == frame_->confirmed.size();
    // proximity-bound reports proximities that are missing.
    if (!is_measured && (has_vertices_ || !frame_->proximity.empty())) return false;
    for (std::size_t k = 0; k < frame_->confirmed.size(); ++k) {
      const Pair p = frame_->confirmed[k];
      const bool is_known = p.i < local_.size() && p.j < local_.size();
      if (is_known && (!is_measured || frame_->proximity[k].is_touching())) touching_.push_back(p);
    }
    std::sort(touching_.begin(), touching_.end());
    return true;
  }

  void judge_pairs() {
    if (!collect_touching()) return;
    if (turn_ == Turn::kAnyColor) judge_colors();
    for (std::size_t k = 0; k < applied_.size(); ++k) {
      const Where where = Where::pair(frame_->step, applied_[k].i, applied_[k].j, "contacts: too many");
      tally_.require(std::binary_search(touching_.begin(), touching_.end(), applied_[k]),
                     "METHOD 3: bodies that do not touch have no contact", where);
      if (k > 0) tally_.require(applied_[k] != applied_[k - 1], "METHOD 4: one contact for a pair and step", where);
    }
    moves_.clear();
    for (const Pair p : touching_) {
      if (std::binary_search(applied_.begin(), applied_.end(), p)) continue;
      if (turn_ == Turn::kUnknown) continue;
      const bool had_parted = were_apart(p);
      parted_ += had_parted ? 1 : 0;
      tally_.require(had_parted, kContactSetOrigin, Where::pair(frame_->step, p.i, p.j, "contacts: missing"));
    }
  }

  // A contact's color is the length of a chain of touching pairs that are resolved before it.
  void judge_colors() {
    for (const Contact& c : frame_->contacts)
      if (!core::is_face(c.b))
        tally_.require(c.color < touching_.size(),
                       "core/method/coloring.hpp: a color is below the number of touching pairs",
                       Where::pair(frame_->step, c.a, c.b, "contact.color"));
  }

  // Was there a moment of the frame at which the two boxes did not overlap on every axis?
  bool were_apart(Pair p) {
    Vec3 x[2] = {frame_->detected_position[p.i], frame_->detected_position[p.j]};
    const auto apart = [&] { return are_apart(p, x[0], x[1]); };
    if (turn_ == Turn::kDetection) return apart();
    const std::uint32_t body[2] = {p.i, p.j};
    if (moves_.empty()) collect_moves();
    // Both bodies' contacts in their common order.
    own_moves_.clear();
    for (const std::uint32_t b : body) {
      auto move = std::lower_bound(moves_.begin(), moves_.end(), std::pair{b, std::uint32_t{0}});
      for (; move != moves_.end() && move->first == b; ++move) own_moves_.push_back(move->second);
    }
    std::sort(own_moves_.begin(), own_moves_.end());
    std::uint32_t color = 0;
    for (std::size_t k = 0; k < own_moves_.size(); ++k) {
      const Contact& c = frame_->contacts[own_moves_[k]];
      const bool is_moment = turn_ == Turn::kAnyMoment || k == 0 || c.color != color;
      if (is_moment && apart()) return true;
      color = c.color;
      for (int side = 0; side < 2; ++side) {
        if (c.a == body[side]) x[side] = c.post_a.x;
        if (c.b == body[side]) x[side] = c.post_b.x;
      }
    }
    return apart();
  }

  // (body, contact) for each contact of two bodies and each of the two.
  void collect_moves() {
    for (std::uint32_t k = 0; k < frame_->contacts.size(); ++k) {
      const Contact& c = frame_->contacts[k];
      if (core::is_face(c.b)) continue;
      for (const std::uint32_t body : {c.a, c.b}) moves_.emplace_back(body, k);
    }
    std::sort(moves_.begin(), moves_.end());
  }

  [[nodiscard]] bool are_apart(Pair p, Vec3 xi, Vec3 xj) const {
    const Box a = core::translated(local_[p.i], xi);
    const Box b = core::translated(local_[p.j], xj);
    for (int k = 0; k < 3; ++k)
      if (!(std::min(a.max[k], b.max[k]) > std::max(a.min[k], b.min[k]))) return true;
    return false;
  }

  void judge_faces() {
    const bool has_end = frame_->position.size() == local_.size();
    std::size_t next = 0;  // of at_face_, the first that is not behind (body, face)
    for (std::uint32_t i = 0; i < local_.size(); ++i) {
      if (!(scene_.bodies[i].inverse_mass > 0.0F)) continue;
      for (std::uint32_t face = 0; face < static_cast<std::uint32_t>(core::kFaceCount); ++face) {
        const std::uint32_t id = core::kFirstFace + face;
        while (next < at_face_.size() && at_face_[next] < FaceContact{i, id, 0}) ++next;
        const bool has_later = next < at_face_.size() && at_face_[next].body == i;
        if (has_later && at_face_[next].face == id) continue;
        if (!has_later && !has_end) continue;
        const Vec3 x = has_later ? frame_->contacts[at_face_[next].contact].pre_a.x : frame_->position[i];
        tally_.require(!is_beyond(core::translated(local_[i], x), face), kFaceOrigin,
                       Where::pair(frame_->step, i, id, "contacts: missing"));
      }
    }
  }

  [[nodiscard]] bool is_beyond(const Box& box, std::uint32_t face) const {
    const int axis = static_cast<int>(face >> 1U);
    return (face & 1U) != 0 ? box.max[axis] > scene_.domain.max[axis] : box.min[axis] < scene_.domain.min[axis];
  }

  struct FaceContact {
    std::uint32_t body;
    std::uint32_t face;     // kFirstFace + k
    std::uint32_t contact;  // index into the frame's contacts
    friend constexpr auto operator<=>(const FaceContact&, const FaceContact&) = default;
  };

  const core::TraceHeader& header_;
  const core::Scene& scene_;
  Turn turn_;
  bool has_pairs_;
  bool has_vertices_;
  std::vector<Box> local_;
  const FrameRecord* frame_ = nullptr;
  std::vector<Pair> applied_;
  std::vector<Pair> touching_;
  std::vector<FaceContact> at_face_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> moves_;
  std::vector<std::uint32_t> own_moves_;
  Tally tally_{"contact-set", "contacts, parted pairs and faces out of reach", kContactSetOrigin};
  std::uint64_t pairs_ = 0;
  std::uint64_t faces_ = 0;
  std::uint64_t parted_ = 0;
};

std::string why_not_contact_set(const Subject& subject) {
  constexpr std::uint32_t kNeeded = core::bit(core::Group::kContacts) | core::bit(core::Group::kBodies);
  if (std::string text = lacking(subject.header, kNeeded); !text.empty()) return text;
  return why_not_method(subject.header);
}

}  // namespace

ValidatorRow contact_set_row() {
  return {"contact-set",
          "each pair that touches and each body beyond a face has exactly one contact, and there are no others",
          "a lost contact; a contact of bodies that do not touch",
          core::bit(core::Group::kContacts) | kPairGroups | core::bit(core::Group::kBodies),
          0,
          why_not_contact_set,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<ContactSet>(subject); }};
}

}  // namespace broadside::validation
