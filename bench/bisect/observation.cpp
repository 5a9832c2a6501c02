#include "bench/bisect/observation.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "bench/bisect/contact_sets.hpp"
#include "bench/forensics/difference_text.hpp"
#include "bench/forensics/trace_difference.hpp"
#include "reports/comparison.hpp"

namespace broadside::bench::bisect {
namespace {

using reports::ChangeKind;

bool is_of(Quantity quantity, ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kVerdictWorse:
    case ChangeKind::kVerdictMissing:
    case ChangeKind::kVerdictBetter:
    case ChangeKind::kCellVanished:
    case ChangeKind::kCellLost:
    case ChangeKind::kCellNew:
      return quantity == Quantity::kVerdict;
    case ChangeKind::kSceneChanged:
      return quantity == Quantity::kDigest;
    case ChangeKind::kMoreWork:
    case ChangeKind::kLessWork:
    case ChangeKind::kCounterVanished:
      return quantity == Quantity::kCounter;
    case ChangeKind::kTimeLost:
    case ChangeKind::kSeriesVanished:
      return quantity == Quantity::kTime;
  }
  return false;
}

// Calls `call` with each pair of cells of the same scene and label that were recorded on both sides.
template <typename Function>
core::Status for_both(const Observation& was, const Observation& is, const Function& call) {
  for (const core::Cell& a : was.rows.cells)
    for (const core::Cell& b : is.rows.cells)
      if (a.stamp.scene_name == b.stamp.scene_name && a.stamp.label() == b.stamp.label() &&
          a.state == core::CellState::kRecorded && b.state == core::CellState::kRecorded)
        if (core::Status s = call(a, b); !s) return s;
  return core::Done{};
}

// The digests of a cell by step: of every frame of its trace, or those that the cell itself holds.
core::Result<std::map<std::uint64_t, std::uint64_t>> digests_of(const Observation& build, const core::Cell& cell) {
  if (cell.trace_file.empty()) return cell.digests;
  const auto trace = core::TraceReader::open(build.folder / cell.trace_file);
  if (!trace) return trace.error();
  std::map<std::uint64_t, std::uint64_t> digests;
  for (std::uint64_t k = 0; k < trace.value().frame_count(); ++k)
    digests[trace.value().steps()[k]] = trace.value().digests()[k];
  return digests;
}

core::Status add_other_digest(const Observation& was, const Observation& is, const core::Cell& a, const core::Cell& b,
                              std::vector<Difference>& found) {
  const auto before = digests_of(was, a);
  if (!before) return before.error();
  const auto after = digests_of(is, b);
  if (!after) return after.error();
  for (const auto& [step, digest] : before.value()) {
    const auto other = after.value().find(step);
    if (other == after.value().end() || other->second == digest) continue;
    found.push_back({a.stamp.scene_name, a.stamp.label(), fmt::format("digest of step {}", step),
                     fmt::format("0x{:016x}", digest), fmt::format("0x{:016x}", other->second)});
    break;
  }
  return core::Done{};
}

std::string contacts_text(std::uint64_t count, const std::string& lowest) {
  const std::string text = count == 1 ? "1 pair touches" : fmt::format("{} pairs touch", count);
  return lowest.empty() ? text : text + ", only here: " + lowest;
}

core::Status add_other_contacts(const Observation& was, const Observation& is, const core::Cell& a, const core::Cell& b,
                                std::vector<Difference>& found) {
  if (a.trace_file.empty() || b.trace_file.empty()) return core::Done{};
  const auto other = compare_contact_sets(was.folder / a.trace_file, is.folder / b.trace_file);
  if (!other) return other.error();
  if (const auto& d = other.value())
    found.push_back({a.stamp.scene_name, a.stamp.label(), fmt::format("contacts of step {}", d->step),
                     contacts_text(d->was, d->only_before), contacts_text(d->is, d->only_after)});
  return core::Done{};
}

}  // namespace

core::Result<Observation> read_observation(const std::filesystem::path& folder, int exit_code) {
  auto rows = core::read_rows(folder);
  if (!rows) return rows.error();
  return Observation{folder, exit_code, std::move(rows).value()};
}

core::Result<std::vector<Difference>> differences(const Observation& was, const Observation& is, Quantity quantity) {
  std::vector<Difference> found;
  if (quantity == Quantity::kExit) {
    if (was.exit_code != is.exit_code)
      found.push_back({"", "", "exit code", std::to_string(was.exit_code), std::to_string(is.exit_code)});
    return found;
  }
  for (const reports::Change& change : reports::compare(was.rows, is.rows).changes)
    if (is_of(quantity, change.kind))
      found.push_back({change.scene, change.label, change.subject, change.was, change.is});
  const auto add = [&](const core::Cell& a, const core::Cell& b) -> core::Status {
    if (quantity == Quantity::kDigest) return add_other_digest(was, is, a, b, found);
    if (quantity == Quantity::kContacts) return add_other_contacts(was, is, a, b, found);
    return core::Done{};
  };
  if (core::Status s = for_both(was, is, add); !s) return s.error();
  return found;
}

std::string traces_apart(const Observation& was, const Observation& is) {
  std::string text;
  const auto add = [&](const core::Cell& a, const core::Cell& b) -> core::Status {
    if (a.trace_file.empty() || b.trace_file.empty()) return core::Done{};
    const auto before = core::TraceReader::open(was.folder / a.trace_file);
    if (!before) return before.error();
    const auto after = core::TraceReader::open(is.folder / b.trace_file);
    if (!after) return after.error();
    const auto apart = compare_traces(before.value(), after.value());
    if (!apart) return apart.error();
    if (!apart.value().is_same()) text += difference_text(before.value(), after.value(), apart.value());
    return core::Done{};
  };
  if (const core::Status s = for_both(was, is, add); !s) text += s.error().line() + "\n";
  return text;
}

}  // namespace broadside::bench::bisect
