// Known defects of the libraries: one table with upstream's issue and what counts as a hit, and the counters that
// adapters keep while they run.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/engine/equivalence.hpp"

namespace broadside::reference {

enum class Defect {
  kBulletStalePairs,
  kBulletNearNormal,
  kFclMeshDepth,
  kFclBoxAxis,
  kFclConvexNormal,
  kFclAbort,
  kFclThrow,
  kFclHang,
  kCcdGjkNan,
  kCcdMprDepth,
  kCcdEpaHang,
  kOdeLcp,
  kMujocoBoxDepth,
};

struct DefectRow {
  Defect defect;
  std::string_view library;
  std::string_view upstream;   // "fcl#491"; "none known"
  std::string_view predicate;  // what counts as a hit
  std::string_view consequence;
};

std::span<const DefectRow> vendor_defects();
const DefectRow& row_of(Defect defect);

// Safe to note from several threads.
class DefectCounter {
 public:
  explicit DefectCounter(Defect defect) : defect_(defect) {}

  void note(std::uint64_t hits, std::uint64_t asked) {
    hits_ += hits;
    asked_ += asked;
  }
  [[nodiscard]] core::DefectHits hits() const;

 private:
  Defect defect_;
  std::atomic<std::uint64_t> hits_{0};
  std::atomic<std::uint64_t> asked_{0};
};

using SharedDefectCounter = std::shared_ptr<DefectCounter>;

// Engine::defects for an adapter with one counter.
inline auto defects_of(const SharedDefectCounter& counter) {
  return [counter] { return std::vector<core::DefectHits>{counter->hits()}; };
}

}  // namespace broadside::reference
