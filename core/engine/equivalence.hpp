// The equivalence card: how an engine's own world differs from the scene that it was given. "Identical scene" is a
// promise that has to be shown, so margins, tolerances, rules and builds are written down in every trace.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::core {

struct EquivalenceFact {
  std::string property;  // "restitution rule"; the same words for the same thing in every engine
  std::string engine;    // what the engine does
  std::string scene;     // what the scene asks for, where it differs; empty = nothing differs

  [[nodiscard]] bool differs() const { return !scene.empty(); }
};

using EquivalenceCard = std::vector<EquivalenceFact>;

// A known defect of a library, and how often this run met it.
struct DefectHits {
  std::string library;    // "FCL 0.7.0"
  std::string upstream;   // "fcl#491", "none known"
  std::string predicate;  // what counts as a hit
  std::uint64_t hits = 0;
  std::uint64_t asked = 0;  // of how many
};

// Adds them as notes of a trace and its cell (TraceHeader::notes, Cell::notes), from which reports read them back.
void add_notes(const EquivalenceCard& card, std::map<std::string, std::string>& notes);
void add_notes(const std::vector<DefectHits>& defects, std::map<std::string, std::string>& notes);

// The fact that such a note holds; nothing for any other note.
std::optional<EquivalenceFact> equivalence_of_note(std::string_view key, std::string_view text);
std::optional<DefectHits> defect_of_note(std::string_view key, std::string_view text);

}  // namespace broadside::core
