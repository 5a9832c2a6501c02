#include "validation/frame_digest.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>

#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

constexpr std::string_view kFrameDigestOrigin =
    "SCHEMA.md, The digest: a sum of the hashes of the frame's records, bit by bit";

// The upper half of a product of two 64-bit numbers, from products of their halves.
std::uint64_t upper_product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kLow = 0xffffffffU;
  const std::uint64_t low = (a & kLow) * (b & kLow);
  const std::uint64_t cross = (a >> 32U) * (b & kLow) + (low >> 32U);
  const std::uint64_t other = (a & kLow) * (b >> 32U) + (cross & kLow);
  return (a >> 32U) * (b >> 32U) + (cross >> 32U) + (other >> 32U);
}

std::uint64_t fold(std::uint64_t a, std::uint64_t b) {
  return (a * b) ^ upper_product(a, b);
}

// Fractions of the square roots of 2, 3 and 5, the first made odd.
constexpr std::uint64_t kRoot2 = 0x6a09e667f3bcc909U;
constexpr std::uint64_t kRoot3 = 0xbb67ae8584caa73bU;
constexpr std::uint64_t kRoot5 = 0x3c6ef372fe94f82bU;

// Words of the record's kind, as ASCII: "body", "pair", "cont", "poin".
constexpr std::uint64_t kBody = 0x626f6479U;
constexpr std::uint64_t kPair = 0x70616972U;
constexpr std::uint64_t kContact = 0x636f6e74U;
constexpr std::uint64_t kPoint = 0x706f696eU;

// What a trace says whose digests cover its points too.
constexpr std::string_view kWithPoints = "bodies, pairs, contacts and points";

// Floats are taken in four at a time, the last four filled up with zeros.
std::uint64_t record_hash(std::uint64_t kind, std::uint64_t identity, std::initializer_list<float> numbers) {
  std::uint64_t hash = fold(identity ^ kRoot2, kind ^ kRoot3);
  for (auto number = numbers.begin(); number != numbers.end();) {
    std::uint64_t word[2] = {0, 0};
    for (int k = 0; k < 4 && number != numbers.end(); ++k, ++number)
      word[k / 2] |= static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(*number)) << (32 * (k % 2));
    hash = fold(word[0] ^ hash, word[1] ^ kRoot5);
  }
  return fold(hash ^ kRoot2, kRoot3);
}

std::uint64_t key(std::uint32_t low, std::uint32_t high) {
  return static_cast<std::uint64_t>(low) << 32U | high;
}

std::uint64_t of_states(const core::FrameRecord& f) {
  std::uint64_t sum = 0;
  const std::size_t bodies =
      std::min({f.position.size(), f.velocity.size(), f.orientation.size(), f.angular_velocity.size()});
  for (std::size_t i = 0; i < bodies; ++i) {
    const core::Quat q = f.orientation[i];
    const core::Vec3 w = f.angular_velocity[i];
    const core::Vec3 x = f.position[i];
    const core::Vec3 v = f.velocity[i];
    sum += record_hash(kBody, i, {q.w, q.x, q.y, q.z, w.x, w.y, w.z, 0, x.x, x.y, x.z, v.x, v.y, v.z});
  }
  for (const core::Pair p : f.confirmed) sum += record_hash(kPair, key(p.i, p.j), {});
  for (const core::Contact& c : f.contacts) {
    const core::Kinematics& a = c.post_a;
    const core::Kinematics& b = c.post_b;
    sum += record_hash(kContact + c.color, key(c.a, c.b), {c.normal.x,  c.normal.y,  c.normal.z,  c.depth_m,
                                                           c.tangent.x, c.tangent.y, c.tangent.z, c.tangent_impulse_n_s,
                                                           a.x.x,       a.x.y,       a.x.z,       c.normal_impulse_n_s,
                                                           a.v.x,       a.v.y,       a.v.z,       b.x.x,
                                                           b.x.y,       b.x.z,       b.v.x,       b.v.y,
                                                           b.v.z});
  }
  return sum;
}

std::uint64_t of_states_and_points(const core::FrameRecord& f) {
  std::uint64_t sum = of_states(f);
  for (const core::ContactPoint& p : f.points)
    sum += record_hash(kPoint, key(p.a, p.b),
                       {p.point.x, p.point.y, p.point.z, p.gap_m, p.normal.x, p.normal.y, p.normal.z, 0, p.impulse.x,
                        p.impulse.y, p.impulse.z, 0, std::bit_cast<float>(p.feature)});
  return sum;
}

// Vigna's splitmix64: one step from z.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

std::uint64_t of_separations(const core::FrameRecord& f) {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < std::min(f.measured.size(), f.separations.size()); ++k) {
    const core::Separation& s = f.separations[k];
    const std::uint64_t touching = s.is_touching ? 1 : 0;
    sum += mix(key(f.measured[k].i, f.measured[k].j) ^ mix(std::bit_cast<std::uint64_t>(s.distance_m) + touching));
  }
  return sum;
}

std::uint64_t of_pairs(const core::FrameRecord& f) {
  std::uint64_t sum = 0;
  for (const core::Pair p : f.pairs) sum += mix(key(p.i, p.j));
  return sum;
}

// What the provenance says about the digests; "" = they are those of SCHEMA.md.
std::string told_kind(const core::TraceHeader& header) {
  const auto note = header.notes.find("digest");
  return note == header.notes.end() ? "" : note->second;
}

using Digest = std::uint64_t (*)(const core::FrameRecord&);

// Computes this trace's digests from what it records; null when it records nothing to compute them from.
Digest digest_of(const core::TraceHeader& header) {
  if (has(header, core::Group::kBodies)) return told_kind(header) == kWithPoints ? of_states_and_points : of_states;
  if (has(header, core::Group::kNarrow)) return of_separations;
  return has(header, core::Group::kPairs) ? of_pairs : nullptr;
}

std::uint64_t none(const core::FrameRecord&) {
  return 0;
}

class FrameDigest final : public Validator {
 public:
  explicit FrameDigest(const Subject& subject)
      : digest_(told_kind(subject.header) == "none" ? none : digest_of(subject.header)) {}

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    const bool is_same = frame.digest == digest_(frame);
    if (!is_same && frame.digest == 0) ++zeros_;
    tally_.check(is_same ? 0.0 : 1.0, {0.0, "frames", kFrameDigestOrigin}, Where::frame(frame.step, "/trace/digest"));
  }

  core::Verdict conclude() override {
    std::string notes;
    if (zeros_ > 0) notes = "an engine without digests says so in /provenance/notes@digest = \"none\"";
    return tally_.conclude("no frames", notes);
  }

 private:
  Digest digest_;
  Tally tally_{"frame-digest", "digests", kFrameDigestOrigin};
  std::uint64_t zeros_ = 0;
};

std::string why_not_frame_digest(const Subject& subject) {
  const std::string kind = told_kind(subject.header);
  if (kind == "none") return {};
  if (!kind.empty() && kind != kWithPoints) return "the engine has a digest of its own (" + kind + ")";
  if (digest_of(subject.header) == nullptr) return "the trace records none of the data that digests cover";
  return {};
}

}  // namespace

ValidatorRow frame_digest_row() {
  return {
      "frame-digest",
      "the recorded digest of a frame is that of its recorded bodies, confirmed pairs and contacts (and points, where "
      "the trace says so)",
      "a digest of another frame; zeros for digests",
      core::bit(core::Group::kBodies) | core::bit(core::Group::kConfirmed) | core::bit(core::Group::kContacts) |
          core::bit(core::Group::kNarrow) | core::bit(core::Group::kPairs) | core::bit(core::Group::kPoints),
      0,
      why_not_frame_digest,
      [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<FrameDigest>(subject); }};
}

}  // namespace broadside::validation
