// The first place where two traces of one scene differ, and the contacts of the bodies there before it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/contact.hpp"
#include "core/contact_point.hpp"
#include "core/result.hpp"
#include "core/trace/frame_difference.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

// What counts as a difference. The default: every bit of every group that both traces have.
class DifferenceRule {
 public:
  virtual ~DifferenceRule() = default;
  // Only those of these groups are compared that both traces have.
  [[nodiscard]] virtual std::uint32_t groups() const { return ~0U; }
  // Whether the counts beside the pairs, the time, and the digest (where both traces mean the same by it) are compared.
  [[nodiscard]] virtual bool includes_bookkeeping() const { return true; }
  // Called with each two frames before they are compared.
  virtual void enter(const core::FrameRecord& /*a*/, const core::FrameRecord& /*b*/) {}
  // Whether a difference by bits may pass.
  virtual bool passes(const core::FrameDifference& /*difference*/) { return false; }
};

struct HistoryContact {
  std::uint64_t step = 0;
  bool is_of_b = false;  // applied in the second trace; before the first difference both traces have the same
  core::Contact contact;
};

struct HistoryPoint {
  std::uint64_t step = 0;
  bool is_of_b = false;
  core::ContactPoint point;
};

// A key that the two engines declare differently; "not declared" where an engine does not.
struct DeclaredDifference {
  std::string key;
  std::string a;
  std::string b;
};

struct TraceDifference {
  std::uint64_t common_steps = 0;
  std::uint64_t equal_steps = 0;  // of them, before the first difference
  std::uint64_t only_in_a = 0;    // steps that the other trace lacks
  std::uint64_t only_in_b = 0;
  std::uint64_t other_digests = 0;  // of the common steps
  bool has_digests = false;         // whether the digests of the two mean the same
  std::vector<std::string> groups;  // compared, as paths
  std::vector<std::string> groups_only_in_a;
  std::vector<std::string> groups_only_in_b;
  std::uint64_t step = 0;  // of the first difference
  std::optional<core::FrameDifference> first;
  // Contacts of the bodies of the first difference, in the ten recorded frames before it (from A) and in its own frame
  // (from both).
  bool has_history = false;
  std::vector<HistoryContact> history;
  // Likewise of points of contact, in traces that have them.
  bool has_points = false;
  std::vector<HistoryPoint> points;
  // Engines may declare different things and still leave the same bits, so this is no difference of the traces.
  std::vector<DeclaredDifference> declared;
  // One of the two holds its states in float64: both are compared as float32.
  bool is_narrowed = false;

  [[nodiscard]] bool is_same() const { return !first && only_in_a == 0 && only_in_b == 0; }
};

// Streams both traces, with one frame of each in memory at a time; reads a frame's groups once. rule: null = compare
// bits. Errors: another scene (except for the number of frames), no step in both, no recorded group in both, a frame
// that cannot be read.
core::Result<TraceDifference> compare_traces(const core::TraceReader& a, const core::TraceReader& b,
                                             DifferenceRule* rule = nullptr,
                                             const std::function<void(std::uint64_t)>& progress = {});

}  // namespace broadside::bench
