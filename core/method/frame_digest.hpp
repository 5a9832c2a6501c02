// The 64-bit digest of a frame. Two engines count as bit-identical when their digests are equal.
#pragma once

#include <bit>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Sum modulo 2^64 of one hash per body, per confirmed pair and per contact. It is a sum so that any number of CPU or
// GPU threads may add their records in any order. Each record's hash starts from a seed and the record's identity, so
// that equal records of different bodies cannot cancel or be swapped without changing the sum.
//
// One multiplication to 128 bits takes in two words and folds its halves together. The former hash, with one 64-bit
// multiplication and three shifts per word, took a sixth of all instructions of a sparse CPU frame. A word can only
// cancel when its neighbor is one value out of 2^64.
class RecordHash {
 public:
  BROADSIDE_HD constexpr RecordHash(std::uint64_t seed, std::uint64_t identity)
      : h_(folded(identity ^ kFirst, seed ^ kSecond)) {}

  BROADSIDE_HD constexpr RecordHash& add(std::uint64_t first, std::uint64_t second) {
    h_ = folded(first ^ h_, second ^ kThird);
    return *this;
  }
  BROADSIDE_HD constexpr RecordHash& add(float a, float b, float c, float d) { return add(word(a, b), word(c, d)); }
  // A sum is only as good as the hash of each record, so the last word is mixed as well as the first.
  BROADSIDE_HD constexpr std::uint64_t value() const { return folded(h_ ^ kFirst, kSecond); }

 private:
  // Odd, with half of their bits set: the fractional parts of the square roots of 2, 3 and 5, the first made odd.
  static constexpr std::uint64_t kFirst = 0x6a09e667f3bcc909ULL;
  static constexpr std::uint64_t kSecond = 0xbb67ae8584caa73bULL;
  static constexpr std::uint64_t kThird = 0x3c6ef372fe94f82bULL;

  __extension__ using Wide = unsigned __int128;
  BROADSIDE_HD static constexpr std::uint64_t folded(std::uint64_t a, std::uint64_t b) {
    const Wide product = static_cast<Wide>(a) * b;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
  }
  BROADSIDE_HD static constexpr std::uint64_t word(float low, float high) {
    return (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(high)) << 32) | std::bit_cast<std::uint32_t>(low);
  }
  std::uint64_t h_;
};

// The part of a body's record that never changes while no body turns: engines that only translate hash it once.
BROADSIDE_HD constexpr RecordHash still_body_digest(std::uint32_t body, Quat q, Vec3 omega) {
  return RecordHash(0x626f6479ULL, body).add(q.w, q.x, q.y, q.z).add(omega.x, omega.y, omega.z, 0.0F);
}

BROADSIDE_HD constexpr std::uint64_t body_digest(RecordHash still, Vec3 x, Vec3 v) {
  return still.add(x.x, x.y, x.z, v.x).add(v.y, v.z, 0.0F, 0.0F).value();
}

BROADSIDE_HD constexpr std::uint64_t body_digest(std::uint32_t body, Vec3 x, Quat q, Vec3 v, Vec3 omega) {
  return body_digest(still_body_digest(body, q, omega), x, v);
}

BROADSIDE_HD constexpr std::uint64_t confirmed_digest(Pair p) {
  return RecordHash(0x70616972ULL, pair_key(p)).value();
}

BROADSIDE_HD constexpr std::uint64_t contact_digest(const Contact& c) {
  const Kinematics& a = c.post_a;
  const Kinematics& b = c.post_b;
  return RecordHash(0x636f6e74ULL + c.color, pair_key({c.a, c.b}))
      .add(c.normal.x, c.normal.y, c.normal.z, c.depth_m)
      .add(c.tangent.x, c.tangent.y, c.tangent.z, c.tangent_impulse_n_s)
      .add(a.x.x, a.x.y, a.x.z, c.normal_impulse_n_s)
      .add(a.v.x, a.v.y, a.v.z, b.x.x)
      .add(b.x.y, b.x.z, b.v.x, b.v.y)
      .add(b.v.z, 0.0F, 0.0F, 0.0F)
      .value();
}

}  // namespace broadside::core
