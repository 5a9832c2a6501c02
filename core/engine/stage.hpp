// The stages of a simulated frame, in order, and their names in reports: the same on the CPU and on the GPU.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace broadside::core {

// The numbers are sections of METHOD.
enum class Stage : std::uint8_t {
  kIntegrate,  // 1: semi-implicit Euler, then boxes
  kBroad,      // 2: candidate pairs
  kConfirm,    // 2: body octrees of candidate pairs, level by level; its name is "levels"
  kVertices,   // 3: nearest vertices of confirmed pairs
  kResponse,   // 4 to 6: contacts between bodies
  kFaces,      // 4 to 6: contacts with faces of the domain, then the velocity cap
};

constexpr std::size_t kStageCount = 6;
constexpr std::array<std::string_view, kStageCount> kStageNames{"integrate", "broad",    "levels",
                                                                "vertices",  "response", "faces"};
static_assert(static_cast<std::size_t>(Stage::kFaces) + 1 == kStageCount);

constexpr std::string_view name_of(Stage stage) {
  return kStageNames[static_cast<std::size_t>(stage)];
}

}  // namespace broadside::core
