// A point's part of a frame's digest, for engines whose digests cover the totals of their points of contact.
#pragma once

#include <string_view>

#include "core/attributes.hpp"
#include "core/contact_point.hpp"
#include "core/method/frame_digest.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// The name of this digest in a trace: /provenance/notes@digest.
inline constexpr std::string_view kDigestWithPoints = "bodies, pairs, contacts and points";

BROADSIDE_HD constexpr std::uint64_t point_digest(const ContactPoint& p) {
  return RecordHash(0x706f696eULL, pair_key({p.a, p.b}))
      .add(p.point.x, p.point.y, p.point.z, p.gap_m)
      .add(p.normal.x, p.normal.y, p.normal.z, 0.0F)
      .add(p.impulse.x, p.impulse.y, p.impulse.z, 0.0F)
      .add(p.feature, 0)
      .value();
}

}  // namespace broadside::core
