// The lanes of a warp share the long loops of contacts: core/method/rigid/lanes.hpp, with the same bits as one lane.
// All lanes of a whole warp call each function of WarpLanes, with the same arguments.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/method/rigid/lanes.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// The value that lane `from` has; each lane may name another `from`.
template <typename T>
__device__ __forceinline__ T of_lane(const T& own, unsigned from) {
  static_assert(sizeof(T) % sizeof(unsigned) == 0);
  unsigned words[sizeof(T) / sizeof(unsigned)];
  memcpy(words, &own, sizeof(T));
#pragma unroll
  for (unsigned& word : words) word = __shfl_sync(kFullWarp, word, from);
  T out;
  memcpy(&out, words, sizeof(T));
  return out;
}

// Where each lane's share of a list lies in it: prefix sums of the lanes' counts.
struct LaneShares {
  unsigned own = 0;
  unsigned end = 0;  // one past the lane's share
  unsigned all = 0;  // of all lanes

  __device__ explicit LaneShares(unsigned count) : own(count), end(count) {
    for (unsigned step = 1; step < 32; step *= 2) {
      const unsigned other = __shfl_up_sync(kFullWarp, end, step);
      if (lane() >= step) end += other;
    }
    all = __shfl_sync(kFullWarp, end, 31);
  }
  // Which lane's share place `at` is in, and which item of that share it is. Called by all lanes, each with a place of
  // its own; beyond the last place the answer means nothing.
  __device__ unsigned owner(unsigned at, unsigned& within) const {
    unsigned found = 0;
    for (unsigned step = 16; step > 0; step /= 2)
      if (__shfl_sync(kFullWarp, end, found + step - 1) <= at) found += step;
    within = at - __shfl_sync(kFullWarp, end - own, found);
    return found;
  }
};

struct WarpLanes {
  static constexpr bool kKnowsLongShapes = true;
  static constexpr bool kLeavesHardPairs = false;
  static constexpr int kLeaf = core::OneLane::kLeaf;

  template <typename Value>
  __device__ static core::FirstLeast first_least(int count, const Value& value) {
    core::FirstLeast least;
    for (int k = own_lane(); k < count; k += 32) {
      const float own = value(k);
      if (own < least.value) least = {k, own};
    }
    for (unsigned step = 16; step > 0; step /= 2) {
      const core::FirstLeast other{static_cast<int>(__shfl_xor_sync(kFullWarp, least.item, step)),
                                   __shfl_xor_sync(kFullWarp, least.value, step)};
      if (other.value < least.value || (other.value == least.value && other.item < least.item)) least = other;
    }
    // If no item of a lane is below the largest number, the lane answers item 0.
    return least;
  }

  template <typename Rate>
  __device__ static int first_best(int count, const Rate& rate) {
    int best = -1;
    core::Rated of_best;
    for (int k = own_lane(); k < count; k += 32) {
      const core::Rated own = rate(k);
      if (!own.counts || (best >= 0 && !core::is_better(own.value, own.key, of_best.value, of_best.key))) continue;
      best = k;
      of_best = own;
    }
    for (unsigned step = 16; step > 0; step /= 2) {
      const int other = __shfl_xor_sync(kFullWarp, best, step);
      const float value = __shfl_xor_sync(kFullWarp, of_best.value, step);
      const std::uint32_t key = __shfl_xor_sync(kFullWarp, of_best.key, step);
      if (other < 0) continue;
      const bool is_alike = value == of_best.value && key == of_best.key;
      if (best >= 0 && !core::is_better(value, key, of_best.value, of_best.key) && !(is_alike && other < best))
        continue;
      best = other;
      of_best = {true, value, key};
    }
    // Lanes may disagree about NaN.
    return __shfl_sync(kFullWarp, best, 0);
  }

  __device__ static float least_of_lanes(float own) {
    for (unsigned step = 16; step > 0; step /= 2) own = fminf(own, __shfl_xor_sync(kFullWarp, own, step));
    return own;
  }

  template <typename Has>
  __device__ static int count_of(int count, const Has& has) {
    int with = 0;
    for (int first = 0; first < count; first += 32) {
      const int k = first + own_lane();
      with += __popc(__ballot_sync(kFullWarp, k < count && has(k)));
    }
    return with;
  }

  template <typename Has, typename Visit>
  __device__ static void each_with(int count, const Has& has, const Visit& visit) {
    for (int first = 0; first < count; first += 32) {
      const int k = first + own_lane();
      for (unsigned with = __ballot_sync(kFullWarp, k < count && has(k)); with != 0; with &= with - 1)
        visit(first + first_of(with));
    }
  }

  template <typename Item, typename Has, typename Make, typename Visit>
  __device__ static void each_made(int count, const Has& has, const Make& make, const Visit& visit) {
    Handful<Item> some;
    for (int from = 0; from < count;) {
      from = some.fill_with(from, count, has, make);
      for (int k = 0; k < some.count; ++k) visit(of_lane(some.own, static_cast<unsigned>(k)));
    }
  }

  // Lanes look at their items as if no earlier one had been visited, and look again after each visit.
  template <typename Has, typename Visit>
  __device__ static void each_in_turn(int count, const Has& has, const Visit& visit) {
    for (int first = 0; first < count; first += 32) {
      const int k = first + own_lane();
      for (unsigned left = kFullWarp; left != 0;) {
        const unsigned with = __ballot_sync(kFullWarp, k < count && has(k)) & left;
        if (with == 0) break;
        visit(first + first_of(with));
        left = behind(first_of(with));
      }
    }
  }

  // The lanes share a stack. Each lane opens one of the top entries, all at once, and what they find replaces these
  // entries, in order. Leaves stay on the stack until all of the top entries are leaves.
  template <typename Open, typename Items, typename Measure, typename Take>
  __device__ static void walk(const Open& open, const Items& items, const Measure& measure, const Take& take) {
    // Entry e of the stack is held by lane e % 32.
    constexpr unsigned kSlots = 64;
    constexpr unsigned kRoom = 32 * kSlots;
    constexpr std::uint32_t kIsLeaf = 0x80000000U;
    core::NodePair slots[kSlots];
    slots[0] = {};
    for (unsigned count = 1; count > 0;) {
      // Fewer entries at once where room is scarce: an entry that is opened alone adds at most one entry a level.
      const unsigned at_once = min(min(32U, count), max(1U, (kRoom - count) / 64U));
      const unsigned holder = (count - 1 - lane()) % 32;  // of the entry that is lane() below the top
      const unsigned below_top = holder;                  // of the entry that this lane holds: the same formula
      core::NodePair pair;
      if (below_top < at_once) pair = slots[(count - 1 - below_top) / 32];
      pair = {__shfl_sync(kFullWarp, pair.a, holder), __shfl_sync(kFullWarp, pair.b, holder)};
      const bool has_one = lane() < at_once;
      const bool is_leaf = has_one && (pair.a & kIsLeaf) != 0;
      if (!__any_sync(kFullWarp, has_one && !is_leaf)) {
        pair.a &= ~kIsLeaf;
        measure_leaves(pair, has_one, items, measure, take);
        count -= at_once;
        continue;
      }
      core::NodePair below[2] = {pair, {}};
      int next = is_leaf ? 1 : 0;
      if (has_one && !is_leaf) {
        next = open(pair, below);
        if (next == kLeaf) {
          below[0] = {pair.a | kIsLeaf, pair.b};
          next = 1;
        }
      }
      const LaneShares shares(static_cast<unsigned>(next));
      const unsigned base = count - at_once;
      for (unsigned half = 0; half < 2; ++half) {
        const unsigned at = base + (lane() - base) % 32 + 32 * half;
        unsigned which = 0;
        const unsigned owner = shares.owner(base + shares.all - 1 - at, which);
        const core::NodePair first{__shfl_sync(kFullWarp, below[0].a, owner),
                                   __shfl_sync(kFullWarp, below[0].b, owner)};
        const core::NodePair second{__shfl_sync(kFullWarp, below[1].a, owner),
                                    __shfl_sync(kFullWarp, below[1].b, owner)};
        if (at < base + shares.all) slots[at / 32] = which == 0 ? first : second;
      }
      count = base + shares.all;
    }
  }

  // Up to 32 items, one in each lane.
  template <typename Item>
  struct Handful {
    int count = 0;
    Item own{};

    template <typename Make>
    __device__ int fill(int from, int end, const Make& make) {
      count = 0;
      while (from < end && count < 32) {
        Item made{};
        const int k = from + own_lane();
        unsigned with = __ballot_sync(kFullWarp, k < end && make(k, made));
        if (with == 0) {
          from = min(from + 32, end);
          continue;
        }
        const int found = min(__popc(with), 32 - count);
        // The item of this lane comes from the lane that made it.
        unsigned source = 0;
        int next = from + 32;
        for (int nth = 0; with != 0; ++nth, with &= with - 1) {
          if (nth == found) {
            next = from + first_of(with);
            break;
          }
          if (own_lane() == count + nth) source = static_cast<unsigned>(first_of(with));
        }
        const Item given = of_lane(made, source);
        if (own_lane() >= count && own_lane() < count + found) own = given;
        count += found;
        from = min(next, end);
      }
      return from;
    }

    template <typename Has, typename Make>
    __device__ int fill_with(int from, int end, const Has& has, const Make& make) {
      Handful<int> numbers;
      from = numbers.fill(from, end, [&](int k, int& number) {
        number = k;
        return has(k);
      });
      count = numbers.count;
      if (own_lane() < count) own = make(numbers.own);
      return from;
    }

    template <typename Change>
    __device__ void each_own(const Change& change) {
      if (own_lane() < count) change(own);
    }
    template <typename Value>
    __device__ core::FirstLeast first_least(const Value& value) const {
      return WarpLanes::first_least(count, [&](int) { return value(own); });
    }
    template <typename Rate>
    __device__ int first_best(const Rate& rate) const {
      return WarpLanes::first_best(count, [&](int) { return rate(own); });
    }
    __device__ Item at(int place) const { return of_lane(own, static_cast<unsigned>(place)); }

    template <typename Has, typename Visit>
    __device__ void each_in_turn(const Has& has, const Visit& visit) const {
      for (unsigned left = kFullWarp; left != 0;) {
        const unsigned with = __ballot_sync(kFullWarp, own_lane() < count && has(own)) & left;
        if (with == 0) break;
        visit(of_lane(own, static_cast<unsigned>(first_of(with))));
        left = behind(first_of(with));
      }
    }
  };

 private:
  __device__ static int own_lane() { return static_cast<int>(lane()); }
  __device__ static int first_of(unsigned lanes) { return __ffs(static_cast<int>(lanes)) - 1; }
  __device__ static unsigned behind(int of) { return of == 31 ? 0 : kFullWarp << (of + 1); }

  // Measures the items of all leaves, 32 at once.
  template <typename Items, typename Measure, typename Take>
  __device__ static void measure_leaves(core::NodePair pair, bool has_one, const Items& items, const Measure& measure,
                                        const Take& take) {
    const LaneShares shares(has_one ? static_cast<unsigned>(items(pair)) : 0U);
    for (unsigned first = 0; first < shares.all; first += 32) {
      unsigned item = 0;
      const unsigned owner = shares.owner(first + lane(), item);
      const core::NodePair leaf{__shfl_sync(kFullWarp, pair.a, owner), __shfl_sync(kFullWarp, pair.b, owner)};
      decltype(measure(leaf, 0)) found;
      if (first + lane() < shares.all) found = measure(leaf, static_cast<int>(item));
      for (unsigned with = __ballot_sync(kFullWarp, found.count > 0); with != 0; with &= with - 1)
        take(of_lane(found, static_cast<unsigned>(first_of(with))));
    }
  }
};

// The same for hulls alone; pairs of hulls whose edges must all be tried are left to WarpLanes.
struct WarpLanesOfHulls : WarpLanes {
  static constexpr bool kLeavesHardPairs = true;
};

}  // namespace broadside::gpu
