// The words for outcomes, places and absences, the same in every kind of report.
#pragma once

#include <string>
#include <string_view>

#include "core/rows.hpp"

namespace broadside::reports {

// Printed beside the word, never instead of it.
constexpr std::string_view symbol(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kPass:
      return "\xE2\x9C\x93";  // check mark
    case core::Outcome::kFail:
      return "\xE2\x9C\x97";  // ballot x
    case core::Outcome::kInconclusive:
      return "?";
    case core::Outcome::kNotApplicable:
      return "\xE2\x80\x93";  // en dash
  }
  return "";
}

// "body 3", "face -y".
std::string body_name(std::uint32_t body);
// "bodies 3 and 17", "body 3 and face -y"; empty without bodies.
std::string bodies_text(const std::vector<std::uint32_t>& bodies);
// "step 1204, bodies 3 and 17, contact.normal"; "no single frame" when the place says nothing.
std::string place_text(const core::Place& place);
// "not measured: no device"; "recorded" when there is nothing to add.
std::string state_text(const core::Cell& cell);

}  // namespace broadside::reports
