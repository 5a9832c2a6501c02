// Who goes through the long loops of contacts: corners, edges and faces of hulls, triangles of meshes. On the host it
// is one lane, one item after the other. On a GPU the lanes of a warp share them (gpu/stages/rigid/warp_lanes.cuh) and
// come to the same bits, because what each of these loops gives is a function of the items and their order alone.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"

namespace broadside::core {

// Larger first; of equal ones the lower key, so that the order of candidates does not matter.
BROADSIDE_HD constexpr bool is_better(float value, std::uint32_t key, float best, std::uint32_t best_key) {
  return value > best || (value == best && key < best_key);
}

// The first item of the least value, and that value; item 0 where none is below it.
struct FirstLeast {
  int item = 0;
  float value = 3.402823e38F;
};

struct Rated {
  bool counts = false;
  float value = 0.0F;
  std::uint32_t key = 0;
};

// Nodes of two trees, or one of a tree and 0.
struct NodePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

// What OneLane and its like have. Lanes see the same values in everything but these loops, whose functions value, rate,
// has, make, open, items and measure are called by single lanes: none of them may begin such a loop. has may be called
// more than once for an item.
struct OneLane {
  static constexpr bool kKnowsLongShapes = true;  // hulls and meshes

  // value(k): of item k.
  template <typename Value>
  BROADSIDE_HD static FirstLeast first_least(int count, const Value& value) {
    FirstLeast least;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k) {
      const float own = value(k);
      if (own < least.value) least = {k, own};
    }
    return least;
  }

  // The first of the best, by is_better, of those that count; -1: none does. rate(k): as Rated.
  template <typename Rate>
  BROADSIDE_HD static int first_best(int count, const Rate& rate) {
    int best = -1;
    Rated of_best;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k) {
      const Rated own = rate(k);
      if (!own.counts || (best >= 0 && !is_better(own.value, own.key, of_best.value, of_best.key))) continue;
      best = k;
      of_best = own;
    }
    return best;
  }

  // The least that a lane has.
  BROADSIDE_HD static float least_of_lanes(float own) { return own; }

  // How many have it.
  template <typename Has>
  BROADSIDE_HD static int count_of(int count, const Has& has) {
    int with = 0;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k)
      if (has(k)) ++with;
    return with;
  }

  // visit(k) for those that have it; what is visited does not change which.
  template <typename Has, typename Visit>
  BROADSIDE_HD static void each_with(int count, const Has& has, const Visit& visit) {
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k)
      if (has(k)) visit(k);
  }

  // visit(make(k)) for those that have it: lanes make the items.
  template <typename Item, typename Has, typename Make, typename Visit>
  BROADSIDE_HD static void each_made(int count, const Has& has, const Make& make, const Visit& visit) {
    each_with(count, has, [&](int k) { visit(make(k)); });
  }

  // visit(k) where a visit may change which have it.
  template <typename Has, typename Visit>
  BROADSIDE_HD static void each_in_turn(int count, const Has& has, const Visit& visit) {
    each_with(count, has, visit);
  }

  // Goes down from nodes {0, 0}, in the order of a stack. open(pair, below) gives how many pairs to go on with, at most
  // two, or kLeaf: then measure(pair, item) for each of its items(pair) gives something with a count, and take(it) gets
  // those of more than 0.
  static constexpr int kLeaf = -1;
  template <typename Open, typename Items, typename Measure, typename Take>
  BROADSIDE_HD static void walk(const Open& open, const Items& items, const Measure& measure, const Take& take) {
    // Depth of a tree is at most 32 levels, and a visit leaves at most one open node a level of either tree.
    constexpr int kOpenNodes = 72;
    NodePair stack[kOpenNodes];
    int count = 1;
    while (count > 0) {
      const NodePair pair = stack[--count];
      NodePair below[2];
      const int next = open(pair, below);
      for (int k = next; k > 0 && count < kOpenNodes; --k) stack[count++] = below[k - 1];
      if (next != kLeaf) continue;
      const int all = items(pair);
      for (int item = 0; item < all; ++item)
        if (const auto found = measure(pair, item); found.count > 0) take(found);
    }
  }

  // Some items of many, in their order.
  template <typename Item>
  struct Handful {
    static constexpr int kMost = 32;
    int count = 0;
    Item items[kMost];

    // Those from item `from` on that make(k, item) makes, as many as there is room for. Returns where it stopped.
    template <typename Make>
    BROADSIDE_HD int fill(int from, int end, const Make& make) {
      count = 0;
      for (; from < end && count < kMost; ++from)
        if (make(from, items[count])) ++count;
      return from;
    }
    // The same by make(k) of those that have it.
    template <typename Has, typename Make>
    BROADSIDE_HD int fill_with(int from, int end, const Has& has, const Make& make) {
      count = 0;
      for (; from < end && count < kMost; ++from)
        if (has(from)) items[count++] = make(from);
      return from;
    }
    // The place of the first item of the least value, as OneLane::first_least, and what is at a place.
    template <typename Value>
    BROADSIDE_HD FirstLeast first_least(const Value& value) const {
      return OneLane::first_least(count, [&](int k) { return value(items[k]); });
    }
    BROADSIDE_HD Item at(int place) const { return items[place]; }
    // visit(item) for those that have it, where a visit may change which.
    template <typename Has, typename Visit>
    BROADSIDE_HD void each_in_turn(const Has& has, const Visit& visit) const {
      BROADSIDE_KEPT_LOOP
      for (int k = 0; k < count; ++k)
        if (has(items[k])) visit(items[k]);
    }
  };
};

// One lane where no shape is a hull or a mesh: their code is left out.
struct OneLaneOfShortShapes : OneLane {
  static constexpr bool kKnowsLongShapes = false;
};

// Of two shapes: that of the one whose loops are shared, if any is.
template <typename PolytopeA, typename PolytopeB>
using LanesOf = std::conditional_t<std::is_same_v<typename PolytopeA::Lanes, OneLane>, typename PolytopeB::Lanes,
                                   typename PolytopeA::Lanes>;

}  // namespace broadside::core
