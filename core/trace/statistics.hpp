// The penetration statistics that METHOD 9 asks for every 100 frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/contact.hpp"

namespace broadside::core {

constexpr std::uint64_t kStatisticsWindow = 100;  // steps, METHOD 9

// Statistics of the recorded frames among steps 100 k + 1 to 100 k + 100 (step 0, the initial state, belongs to the
// first window). The depths are those of body contacts before each application; contacts with faces of the domain are
// counted separately. Mean, largest and share are NaN when there was no body contact.
struct PenetrationStatistics {
  std::uint64_t first_step = 0;
  std::uint64_t last_step = 0;
  std::uint64_t frames = 0;
  std::uint64_t body_contacts = 0;
  std::uint64_t face_contacts = 0;
  double mean_depth_m = 0.0;
  double largest_depth_m = 0.0;
  double share_above_slop = 0.0;  // body contacts with depth > delta, over body contacts
};

// Takes frames in rising order of step and gives one row per window.
class PenetrationCounter {
 public:
  explicit PenetrationCounter(float delta_m) : delta_m_(delta_m) {}

  // When this frame opens a new window, returns the row of the previous one.
  std::optional<PenetrationStatistics> add(std::uint64_t step, std::span<const Contact> contacts);
  // The row of the open window, if any frame is in it. Nothing may be added afterwards.
  [[nodiscard]] std::optional<PenetrationStatistics> rest() const;

 private:
  float delta_m_;
  PenetrationStatistics open_;
  double depth_sum_m_ = 0.0;
  std::uint64_t above_slop_ = 0;
};

}  // namespace broadside::core
