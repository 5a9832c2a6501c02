// Seeded families of boxes for property tests, the plain search that they are judged by, and the shrinking of a case
// that fails to the fewest boxes that still fail.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside::tests {

struct BoxCase {
  std::vector<core::Box> boxes;
  std::vector<std::uint8_t> is_static;
  core::Box domain;
};

// Draws for a family. The standard's distributions differ between libraries; these do not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}
  // In [low, high).
  float between(float low, float high) { return low + (high - low) * (static_cast<float>(bits_() >> 40U) * 0x1p-24F); }
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(bits_() % count); }
  // Any pattern of bits that is a finite float.
  float finite_float() {
    for (;;) {
      const float v = std::bit_cast<float>(static_cast<std::uint32_t>(bits_() >> 32U));
      if (std::isfinite(v)) return v;
    }
  }

 private:
  std::mt19937_64 bits_;
};

inline core::Box box_at(core::Vec3 c, core::Vec3 sides) {
  return {{c.x - 0.5F * sides.x, c.y - 0.5F * sides.y, c.z - 0.5F * sides.z},
          {c.x + 0.5F * sides.x, c.y + 0.5F * sides.y, c.z + 0.5F * sides.z}};
}

// A side from two floats in order, or in either order where they are equal: min +0 and max -0 is a sound side.
inline void put_side(core::Box& box, int axis, float a, float b) {
  box.min[axis] = b < a ? b : a;
  box.max[axis] = b < a ? a : b;
}

struct BoxFamily {
  std::string_view name;
  core::Box (*draw)(Draw& draw, std::uint32_t k, float count);
};

// A cube that holds `count` unit cells.
inline float cube_side(float count) {
  return std::cbrt(count);
}

inline constexpr BoxFamily kBoxFamilies[] = {
    {"uniform",
     [](Draw& d, std::uint32_t, float n) {
       const float w = cube_side(n);
       return box_at({d.between(0, w), d.between(0, w), d.between(0, w)},
                     {d.between(0.5F, 1.5F), d.between(0.5F, 1.5F), d.between(0.5F, 1.5F)});
     }},
    // Two dense clumps in a world 1e5 times wider, with strays.
    {"clumps",
     [](Draw& d, std::uint32_t k, float n) {
       const float w = k % 64 == 0 ? 1e5F : cube_side(n);
       const float at = k % 2 == 0 ? 0.0F : 9e4F;
       const core::Vec3 c{at + d.between(0, w), at + d.between(0, w), d.between(0, w)};
       return box_at(c, {d.between(0.8F, 1.2F), d.between(0.8F, 1.2F), d.between(0.8F, 1.2F)});
     }},
    // Sides over three orders of magnitude, Pareto with exponent 2.
    {"sizes 1 to 1000",
     [](Draw& d, std::uint32_t, float n) {
       const float w = cube_side(520.0F * n);
       const float s = std::fmin(1000.0F, 1.0F / std::sqrt(1.0F - d.between(0, 1)));
       return box_at({d.between(0, w), d.between(0, w), d.between(0, w)},
                     {s * d.between(0.8F, 1.2F), s * d.between(0.8F, 1.2F), s * d.between(0.8F, 1.2F)});
     }},
    // Sizes over the whole range of float32's exponents, so that every size class is in use.
    {"sizes 1e-30 to 1e30",
     [](Draw& d, std::uint32_t, float) {
       const float s = std::exp2(d.between(-100.0F, 100.0F));
       return box_at({s * d.between(-1, 1), s * d.between(-1, 1), s * d.between(-1, 1)}, {s, s, s});
     }},
    {"identical",
     [](Draw&, std::uint32_t k, float n) {
       // In groups, since boxes that are all alike would give n^2 / 2 pairs.
       const auto group = static_cast<float>(k % (1U + static_cast<std::uint32_t>(n / 32.0F)));
       return core::Box{{group * 4.0F, 1.0F, 1.0F}, {group * 4.0F + 1.0F, 2.0F, 2.0F}};
     }},
    // Cells of a lattice: neighbors touch on faces, edges and corners, exactly.
    {"touching lattice",
     [](Draw&, std::uint32_t k, float n) {
       const auto side = static_cast<std::uint32_t>(cube_side(n)) + 1U;
       const core::Vec3 low{static_cast<float>(k % side), static_cast<float>(k / side % side),
                            static_cast<float>(k / side / side)};
       return core::Box{low, {low.x + 1.0F, low.y + 1.0F, low.z + 1.0F}};
     }},
    {"line",
     [](Draw& d, std::uint32_t, float n) {
       return box_at({d.between(0, n / 4.0F), 0, 0}, {1.0F, 1.0F, 1.0F});
     }},
    {"plane",
     [](Draw& d, std::uint32_t, float n) {
       const float w = std::sqrt(n / 4.0F);
       return box_at({d.between(0, w), 5.0F, d.between(0, w)}, {1.0F, 0.0F, 1.0F});
     }},
    // Points on a coarse lattice: many coincide.
    {"zero size",
     [](Draw& d, std::uint32_t, float) {
       const core::Vec3 p{static_cast<float>(d.below(8)), static_cast<float>(d.below(8)),
                          static_cast<float>(d.below(8))};
       return core::Box{p, p};
     }},
    // Far from the origin float32 resolves 1/16 m: sides and positions round.
    {"a million metres out",
     [](Draw& d, std::uint32_t, float n) {
       const float w = cube_side(n);
       return box_at({1e6F + d.between(0, w), -1e6F + d.between(0, w), 1e6F + d.between(0, w)}, {1.0F, 1.0F, 1.0F});
     }},
    {"micrometres",
     [](Draw& d, std::uint32_t, float n) {
       const float w = 1e-6F * cube_side(n);
       return box_at({d.between(0, w), d.between(0, w), d.between(0, w)}, {1e-6F, 1e-6F, 1e-6F});
     }},
    {"denormals",
     [](Draw& d, std::uint32_t, float n) {
       const float w = 1e-42F * cube_side(n);
       return box_at({d.between(-w, w), d.between(-w, w), d.between(-w, w)}, {1e-42F, 2e-42F, 1e-42F});
     }},
    // Sums and differences of such coordinates overflow float32.
    {"near the largest float",
     [](Draw& d, std::uint32_t, float) {
       return box_at({3e38F * d.between(-1, 1), 3e38F * d.between(-1, 1), 3e38F * d.between(-1, 1)},
                     {5e37F, 5e37F, 5e37F});
     }},
    // One stray so far away that every other box falls into one cell of a grid over all.
    {"one stray at 1e30",
     [](Draw& d, std::uint32_t k, float n) {
       const float w = cube_side(n);
       const float at = k == 7 ? 1e30F : 0.0F;
       return box_at({at + d.between(0, w), at + d.between(0, w), d.between(0, w)}, {1.0F, 1.0F, 1.0F});
     }},
    {"rods and plates",
     [](Draw& d, std::uint32_t k, float n) {
       const float w = cube_side(n) * 2.0F;
       core::Vec3 sides{0.1F, 0.1F, 0.1F};
       sides[static_cast<int>(k % 3)] = w;
       if (k % 7 == 0) sides[static_cast<int>((k + 1) % 3)] = w;
       return box_at({d.between(0, w), d.between(0, w), d.between(0, w)}, sides);
     }},
    // Any finite float is as likely as any other.
    {"every finite float",
     [](Draw& d, std::uint32_t, float) {
       core::Box box;
       for (int axis = 0; axis < 3; ++axis) put_side(box, axis, d.finite_float(), d.finite_float());
       return box;
     }},
    // Corners at all exponents, sides mostly shorter than that.
    {"places and sizes of every exponent",
     [](Draw& d, std::uint32_t, float) {
       core::Box box;
       const float scale = std::exp2(d.between(-40.0F, 0.0F));
       for (int axis = 0; axis < 3; ++axis) {
         const float at = d.finite_float();
         const float to = at + at * scale;
         put_side(box, axis, at, std::isfinite(to) ? to : at);
       }
       return box;
     }},
    // Zeros of both signs, the smallest subnormals and normals, and their neighbors: numbers that differ by a sign or a
    // bit.
    {"signed zeros and subnormals",
     [](Draw& d, std::uint32_t, float) {
       constexpr float kValues[] = {0.0F, -0.0F, 0x1p-149F, -0x1p-149F, 0x1p-148F, 0x1p-126F, -0x1p-126F, 0x1.8p-127F};
       core::Box box;
       for (int axis = 0; axis < 3; ++axis) put_side(box, axis, kValues[d.below(8)], kValues[d.below(8)]);
       return box;
     }},
    // The same, as one box among usual ones: a side of -0 once indexed a table of sizes by its sign.
    {"one box from +0 to -0",
     [](Draw& d, std::uint32_t k, float n) {
       const float w = cube_side(n);
       if (k == 3) return core::Box{{0.0F, 0.0F, 0.0F}, {-0.0F, -0.0F, -0.0F}};
       return box_at({d.between(0, w), d.between(0, w), d.between(0, w)}, {1.0F, 1.0F, 1.0F});
     }},
    // Lattices of a few subnormal steps: half of an odd number of steps must be rounded.
    {"a few smallest steps",
     [](Draw& d, std::uint32_t, float) {
       core::Box box;
       for (int axis = 0; axis < 3; ++axis) {
         const auto at = static_cast<float>(2U + d.below(40));
         put_side(box, axis, at * 0x1p-149F, (at + static_cast<float>(d.below(3))) * 0x1p-149F);
       }
       return box;
     }},
    // From end to end of what a float can hold: sides overflow, and beginnings less a side do too.
    {"at the ends of floats",
     [](Draw& d, std::uint32_t, float) {
       constexpr float kMost = 0x1.fffffep127F;
       core::Box box;
       for (int axis = 0; axis < 3; ++axis) {
         const float at = d.below(3) == 0 ? -kMost : kMost * d.between(-1, 1);
         const float to = d.below(9) == 0 ? kMost : at + kMost * d.between(0, 0.1F);
         put_side(box, axis, at, std::isfinite(to) ? to : kMost);
       }
       return box;
     }},
};

inline BoxCase make_case(const BoxFamily& family, std::uint32_t count, std::uint64_t seed) {
  BoxCase boxes;
  Draw draw(seed);
  for (std::uint32_t k = 0; k < count; ++k) {
    boxes.boxes.push_back(family.draw(draw, k, static_cast<float>(count)));
    boxes.is_static.push_back(draw.below(8) == 0 ? 1 : 0);
  }
  // A domain that some boxes straddle or leave, as scenes may.
  const float w = cube_side(static_cast<float>(count));
  boxes.domain = {{0.0F, 0.0F, 0.0F}, {w, w, 0.75F * w}};
  return boxes;
}

// Every pair tried, written out here apart from core's formulas.
inline std::vector<core::Pair> every_pair(const BoxCase& c) {
  std::vector<core::Pair> pairs;
  const auto meet = [](float min_a, float max_a, float min_b, float max_b) {
    return std::fmax(min_a, min_b) <= std::fmin(max_a, max_b);
  };
  for (std::uint32_t i = 0; i < c.boxes.size(); ++i) {
    const core::Box& a = c.boxes[i];
    for (std::uint32_t j = i + 1; j < c.boxes.size(); ++j) {
      const core::Box& b = c.boxes[j];
      if (c.is_static[i] != 0 && c.is_static[j] != 0) continue;
      if (meet(a.min.x, a.max.x, b.min.x, b.max.x) && meet(a.min.y, a.max.y, b.min.y, b.max.y) &&
          meet(a.min.z, a.max.z, b.min.z, b.max.z))
        pairs.push_back({i, j});
    }
  }
  return pairs;
}

using Finder = std::function<std::vector<core::Pair>(const BoxCase&)>;

// Leaves out ever smaller runs of boxes while the finder stays wrong.
inline BoxCase shrunk(BoxCase wrong, const Finder& finder) {
  for (std::size_t run = wrong.boxes.size() / 2; run > 0; run /= 2) {
    for (std::size_t begin = 0; begin + run <= wrong.boxes.size();) {
      BoxCase fewer = wrong;
      const auto from = static_cast<std::ptrdiff_t>(begin);
      const auto to = static_cast<std::ptrdiff_t>(begin + run);
      fewer.boxes.erase(fewer.boxes.begin() + from, fewer.boxes.begin() + to);
      fewer.is_static.erase(fewer.is_static.begin() + from, fewer.is_static.begin() + to);
      if (finder(fewer) != every_pair(fewer))
        wrong = std::move(fewer);
      else
        begin += run;
    }
  }
  return wrong;
}

// Empty when the finder is right; otherwise what is wrong with the smallest case that is still wrong, as box literals.
inline std::string disagreement(const BoxCase& boxes, const Finder& finder) {
  if (finder(boxes) == every_pair(boxes)) return {};
  const BoxCase least = shrunk(boxes, finder);
  std::ostringstream text;
  text << std::hexfloat << "wrong for these " << least.boxes.size() << " boxes {min}, {max}, static:\n";
  for (std::size_t k = 0; k < least.boxes.size(); ++k) {
    const core::Box& b = least.boxes[k];
    text << "{{" << b.min.x << "F, " << b.min.y << "F, " << b.min.z << "F}, {" << b.max.x << "F, " << b.max.y << "F, "
         << b.max.z << "F}}, " << int{least.is_static[k]} << '\n';
  }
  const auto list = [&](std::string_view title, const std::vector<core::Pair>& pairs) {
    text << title;
    for (const core::Pair p : pairs) text << " (" << p.i << ", " << p.j << ')';
    text << '\n';
  };
  list("expected:", every_pair(least));
  list("found:   ", finder(least));
  return text.str();
}

}  // namespace broadside::tests
