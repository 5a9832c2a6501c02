// Rows of the C interface as rows of a frame, and the fault of rows that no trace may hold.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>

#include "core/plugin/broadside_engine_v2.h"
#include "core/trace/frame.hpp"

namespace broadside::reference {

// Whether a row was left as it was: room for rows is filled with bytes 0xFF before a plug-in writes to it.
template <typename Row>
bool is_unwritten(const Row& row) {
  unsigned char blank[sizeof(Row)];
  std::memset(blank, 0xFF, sizeof blank);
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): it is the bytes that are asked for
  return std::memcmp(&row, blank, sizeof row) == 0;
}

void add_state(const broadside_state2& state, core::FrameRecord& frame);
void add_detection(const broadside_detection& seen, core::FrameRecord& frame);
core::ContactPoint point_from_c(const broadside_point& point);
// A plug-in gives only the order of application: every contact gets a color of its own.
core::Contact contact_from_c(const broadside_contact& contact);

// "is between 3 and 9, and there are 4 bodies"; empty when both exist and differ.
std::string fault_of_bodies(std::uint32_t a, std::uint32_t b, std::uint32_t body_count);
// The same, and the fault of numbers that are not finite.
std::string fault_of_point(const broadside_point& point, std::uint32_t body_count);

}  // namespace broadside::reference
