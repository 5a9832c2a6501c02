// What may change between two builds.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace broadside::bench::bisect {

enum class Quantity {
  kVerdict,   // an outcome of a law, or the state of a cell
  kContacts,  // which bodies touch in some frame
  kDigest,    // any bit of a recorded frame, or the scene itself
  kCounter,   // counted work
  kTime,      // slower or faster, by the gate of 'compare'
  kExit,      // the exit code of the command
};

struct QuantityWord {
  Quantity quantity;
  std::string_view word;
};

inline constexpr std::array kQuantityWords{
    QuantityWord{Quantity::kVerdict, "verdict"}, QuantityWord{Quantity::kContacts, "contacts"},
    QuantityWord{Quantity::kDigest, "digest"},   QuantityWord{Quantity::kCounter, "counter"},
    QuantityWord{Quantity::kTime, "time"},       QuantityWord{Quantity::kExit, "exit"}};

constexpr std::string_view quantity_word(Quantity quantity) {
  for (const QuantityWord& row : kQuantityWords)
    if (row.quantity == quantity) return row.word;
  return "unknown";
}

// One difference between two builds: "errata:E3, octree-cpu: center-of-mass: pass, then fail".
struct Difference {
  std::string scene;
  std::string label;  // of the engine
  std::string subject;
  std::string was;
  std::string is;
};

}  // namespace broadside::bench::bisect
