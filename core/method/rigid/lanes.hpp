// The lanes that run the long loops of contacts: over corners, edges and faces of hulls, and over triangles of meshes.
// On the host one lane does all items in turn. On a GPU the lanes of a warp share the items
// (gpu/stages/rigid/warp_lanes.cuh). The bits are the same, because the result of each loop is a function of the items
// and their order alone.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/room.hpp"

namespace broadside::core {

// The larger value is better; of equal values the lower key, so that the order of candidates does not matter.
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

// What OneLane and its like provide. Outside these loops all lanes have the same values. The functions that are passed
// in (value, rate, has, make, open, items and measure) are called by single lanes, so they must not begin such a loop.
// has may be called more than once for an item.
struct OneLane {
  static constexpr bool kKnowsLongShapes = true;  // hulls and meshes
  static constexpr bool kLeavesHardPairs = false;

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

  // The first of the best items by is_better; -1 if none counts. rate(k) gives a Rated.
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

  // The least of the lanes' values.
  BROADSIDE_HD static float least_of_lanes(float own) { return own; }

  // The number of items for which has(k) is true.
  template <typename Has>
  BROADSIDE_HD static int count_of(int count, const Has& has) {
    int with = 0;
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k)
      if (has(k)) ++with;
    return with;
  }

  // visit(k) for items with has(k); a visit must not change which items have it.
  template <typename Has, typename Visit>
  BROADSIDE_HD static void each_with(int count, const Has& has, const Visit& visit) {
    BROADSIDE_KEPT_LOOP
    for (int k = 0; k < count; ++k)
      if (has(k)) visit(k);
  }

  // visit(make(k)) for items with has(k): lanes make the items.
  template <typename Item, typename Has, typename Make, typename Visit>
  BROADSIDE_HD static void each_made(int count, const Has& has, const Make& make, const Visit& visit) {
    each_with(count, has, [&](int k) { visit(make(k)); });
  }

  // visit(k) for items with has(k), where a visit may change which items have it.
  template <typename Has, typename Visit>
  BROADSIDE_HD static void each_in_turn(int count, const Has& has, const Visit& visit) {
    each_with(count, has, visit);
  }

  // Walks down two trees from nodes {0, 0}, in the order of a stack. open(pair, below) returns how many pairs to go on
  // with, at most two, or kLeaf. For each item of a leaf, of which there are items(pair), measure(pair, item) gives a
  // result with a count, and take gets the results whose count is above 0.
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
    Room<Item, kMost> items;

    // The items from `from` on that make(k, item) makes, as many as there is room for. Returns where it stopped.
    template <typename Make>
    BROADSIDE_HD int fill(int from, int end, const Make& make) {
      count = 0;
      for (; from < end && count < kMost; ++from)
        if (make(from, items[count])) ++count;
      return from;
    }
    // The same by make(k), for items with has(k).
    template <typename Has, typename Make>
    BROADSIDE_HD int fill_with(int from, int end, const Has& has, const Make& make) {
      count = 0;
      for (; from < end && count < kMost; ++from)
        if (has(from)) items[count++] = make(from);
      return from;
    }
    // Each lane calls change(item) for those that it holds.
    template <typename Change>
    BROADSIDE_HD void each_own(const Change& change) {
      BROADSIDE_KEPT_LOOP
      for (int k = 0; k < count; ++k) change(items[k]);
    }
    // The place of the first item of the least value, as OneLane::first_least. at(place) gives the item itself.
    template <typename Value>
    BROADSIDE_HD FirstLeast first_least(const Value& value) const {
      return OneLane::first_least(count, [&](int k) { return value(items[k]); });
    }
    // The place of the best item, as OneLane::first_best.
    template <typename Rate>
    BROADSIDE_HD int first_best(const Rate& rate) const {
      return OneLane::first_best(count, [&](int k) { return rate(items[k]); });
    }
    BROADSIDE_HD Item at(int place) const { return items[place]; }
    // visit(item) for items with has, where a visit may change which items have it.
    template <typename Has, typename Visit>
    BROADSIDE_HD void each_in_turn(const Has& has, const Visit& visit) const {
      BROADSIDE_KEPT_LOOP
      for (int k = 0; k < count; ++k)
        if (has(items[k])) visit(items[k]);
    }
  };
};

// One lane, for scenes without hulls and meshes: their code is left out.
struct OneLaneOfShortShapes : OneLane {
  static constexpr bool kKnowsLongShapes = false;
};

// One lane of many, each of which has its own pair of hulls. If a pair needs loops over all edges, the lane leaves it
// to lanes that share these loops, because the other lanes would wait for it.
struct OneLaneOfHulls : OneLane {
  static constexpr bool kLeavesHardPairs = true;
};

// Returned in place of a count: the lane has left the pair to lanes that share its loops.
inline constexpr int kLeft = -1;

// For a pair of shapes: the lanes of the shape whose loops are shared, if there is one.
template <typename PolytopeA, typename PolytopeB>
using LanesOf = std::conditional_t<std::is_same_v<typename PolytopeA::Lanes, OneLane>, typename PolytopeB::Lanes,
                                   typename PolytopeA::Lanes>;

}  // namespace broadside::core
