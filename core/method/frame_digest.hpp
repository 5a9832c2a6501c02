// The 64-bit digest of a frame: what two engines must share to count as bit-identical.
#pragma once

#include <bit>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Sum modulo 2^64 of one hash per body, per confirmed pair and per contact. A sum, so that any number of CPU or GPU
// threads may add their records in any order; each record's hash starts from a seed and its own identity, so equal
// records of different bodies do not cancel or swap unseen.
class RecordHash {
 public:
  BROADSIDE_HD constexpr RecordHash(std::uint64_t seed, std::uint64_t identity)
      : h_(splitmix64(seed ^ splitmix64(identity))) {}

  BROADSIDE_HD constexpr RecordHash& add(std::uint64_t word) {
    h_ = splitmix64(h_ ^ word);
    return *this;
  }
  BROADSIDE_HD constexpr RecordHash& add(float low, float high) {
    return add((static_cast<std::uint64_t>(bits(high)) << 32) | bits(low));
  }
  BROADSIDE_HD constexpr RecordHash& add(Vec3 v, float fourth) { return add(v.x, v.y).add(v.z, fourth); }
  BROADSIDE_HD constexpr std::uint64_t value() const { return h_; }

 private:
  BROADSIDE_HD static constexpr std::uint32_t bits(float f) { return std::bit_cast<std::uint32_t>(f); }
  std::uint64_t h_;
};

BROADSIDE_HD constexpr std::uint64_t body_digest(std::uint32_t body, Vec3 x, Quat q, Vec3 v, Vec3 omega) {
  return RecordHash(0x626f6479ULL, body).add(x, v.x).add(v.y, v.z).add(q.w, q.x).add(q.y, q.z).add(omega, 0.0F).value();
}

BROADSIDE_HD constexpr std::uint64_t confirmed_digest(Pair p) {
  return RecordHash(0x70616972ULL, pair_key(p)).value();
}

BROADSIDE_HD constexpr std::uint64_t contact_digest(const Contact& c) {
  return RecordHash(0x636f6e74ULL, pair_key({c.a, c.b}))
      .add(c.color)
      .add(c.normal, c.depth_m)
      .add(c.tangent, c.tangent_impulse_n_s)
      .add(c.post_a.x, c.normal_impulse_n_s)
      .add(c.post_a.v, c.post_b.x.x)
      .add(c.post_b.x.y, c.post_b.x.z)
      .add(c.post_b.v, 0.0F)
      .value();
}

}  // namespace broadside::core
