#include "reports/wording.hpp"

#include <array>

#include "core/contact.hpp"

namespace broadside::reports {

std::string body_name(std::uint32_t body) {
  constexpr std::array<std::string_view, core::kFaceCount> kFaces{"-x", "+x", "-y", "+y", "-z", "+z"};
  if (!core::is_face(body)) return "body " + std::to_string(body);
  const std::uint32_t face = body - core::kFirstFace;
  return face < kFaces.size() ? "face " + std::string(kFaces[face]) : "face " + std::to_string(face);
}

std::string bodies_text(const std::vector<std::uint32_t>& bodies) {
  bool has_face = false;
  for (const std::uint32_t body : bodies) has_face = has_face || core::is_face(body);
  if (bodies.size() == 1 || (has_face && bodies.size() == 2)) {
    std::string text = body_name(bodies[0]);
    if (bodies.size() == 2) text += " and " + body_name(bodies[1]);
    return text;
  }
  std::string text = bodies.empty() ? "" : "bodies ";
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (k > 0) text += k + 1 == bodies.size() ? " and " : ", ";
    text += core::is_face(bodies[k]) ? body_name(bodies[k]) : std::to_string(bodies[k]);
  }
  return text;
}

std::string place_text(const core::Place& place) {
  std::string text = place.step >= 0 ? "step " + std::to_string(place.step) : "";
  for (const std::string& part : {bodies_text(place.bodies), place.field})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text.empty() ? "no single frame" : text;
}

std::string state_text(const core::Cell& cell) {
  std::string text(core::cell_state_word(cell.state));
  if (!cell.reason.empty()) text += ": " + cell.reason;
  return text;
}

}  // namespace broadside::reports
