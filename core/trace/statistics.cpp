#include "core/trace/statistics.hpp"

#include <algorithm>
#include <limits>

namespace broadside::core {
namespace {

std::uint64_t window_of(std::uint64_t step) {
  return step == 0 ? 0 : (step - 1) / kStatisticsWindow;
}

}  // namespace

std::optional<PenetrationStatistics> PenetrationCounter::add(std::uint64_t step, std::span<const Contact> contacts) {
  std::optional<PenetrationStatistics> done;
  if (open_.frames > 0 && window_of(step) != window_of(open_.last_step)) {
    done = rest();
    *this = PenetrationCounter(delta_m_);
  }
  if (open_.frames == 0) open_.first_step = step;
  open_.last_step = step;
  ++open_.frames;
  for (const Contact& c : contacts) {
    if (is_face(c.b)) {
      ++open_.face_contacts;
      continue;
    }
    open_.largest_depth_m =
        open_.body_contacts == 0 ? c.depth_m : std::max(open_.largest_depth_m, static_cast<double>(c.depth_m));
    ++open_.body_contacts;
    depth_sum_m_ += c.depth_m;
    if (c.depth_m > delta_m_) ++above_slop_;
  }
  return done;
}

std::optional<PenetrationStatistics> PenetrationCounter::rest() const {
  if (open_.frames == 0) return std::nullopt;
  PenetrationStatistics row = open_;
  if (row.body_contacts == 0) {
    row.mean_depth_m = row.largest_depth_m = row.share_above_slop = std::numeric_limits<double>::quiet_NaN();
  } else {
    const auto count = static_cast<double>(row.body_contacts);
    row.mean_depth_m = depth_sum_m_ / count;
    row.share_above_slop = static_cast<double>(above_slop_) / count;
  }
  return row;
}

}  // namespace broadside::core
