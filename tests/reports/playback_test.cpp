// What the 3-D view gets: positions to within half a cell, faces by name, and nothing that could end its element.
#include "reports/playback.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "core/contact.hpp"
#include "tests/reports/markup_checker.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Base64 of RFC 4648, decoded: the reverse of the code under test.
std::vector<unsigned> bytes_of(const std::string& text) {
  std::vector<unsigned> bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    value = value << 6U | static_cast<unsigned>(kDigits.find(c));
    if ((bits += 6) >= 8) bytes.push_back(value >> (bits -= 8) & 0xFFU);
  }
  return bytes;
}

std::vector<unsigned> words_of(const std::string& text) {
  const std::vector<unsigned> bytes = bytes_of(text);
  std::vector<unsigned> words;
  for (std::size_t k = 0; k + 1 < bytes.size(); k += 2) words.push_back(bytes[k] | bytes[k + 1] << 8U);
  return words;
}

Playback two_cubes() {
  const core::Box cube{{-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}};
  Playback p;
  p.stamp = {.scene_name = "</script><script>", .engine = "e"};
  p.domain = {{-4, -4, -4}, {4, 4, 4}};
  p.up = {0, 1, 0};
  p.dt_s = 0.01;
  p.last_step = 7;
  p.shape_of_body = {0, 0};
  p.shapes.push_back({{{cube}}, {}, {}});
  p.frames.push_back(
      {3, {{-1.25F, 0, 2}, {3.5F, -2, 0}}, {}, {{0, 1}}, {{0, core::kFirstFace + 2, {1, 2, 3}, {0, 1, 0}, 0.25F}}});
  p.frames.push_back({7, {{0, 0, 0}, {1, 1, 1}}, {}, {}, {}});
  p.marks.push_back({"fail: law at step 3, bodies 0 and face -y", "law", "", 3, {0, core::kFirstFace + 2}});
  return p;
}

TEST(Playback, PositionsSurviveToHalfACell) {
  const auto json = nlohmann::json::parse(playbacks_json({two_cubes()}))[0];
  EXPECT_EQ(json["steps"], (std::vector<int>{3, 7}));
  const std::vector<unsigned> words = words_of(json["positions"]);
  ASSERT_EQ(words.size(), 12U);
  const double expected[] = {-1.25, 0, 2, 3.5, -2, 0, 0, 0, 0, 1, 1, 1};
  for (std::size_t k = 0; k < 12; ++k) {
    const double cell = json["cell"][k % 3];
    EXPECT_NEAR(json["min"][k % 3].get<double>() + words[k] * cell, expected[k], 0.51 * cell) << k;
    EXPECT_LT(cell, 6.0 / 65535) << "the extent is at most 5.5 m";
  }
}

TEST(Playback, FacesFollowTheLastBodyAndContactsKeepTheirNormal) {
  const auto json = nlohmann::json::parse(playbacks_json({two_cubes()}))[0];
  const std::vector<unsigned> c = words_of(json["contacts"]);
  ASSERT_EQ(c.size(), 9U);
  EXPECT_EQ(c[0], 0U);
  EXPECT_EQ(c[1], 4U) << "two bodies, then -x +x -y";
  EXPECT_NEAR(c[6] / 32767.5 - 1.0, 1.0, 1e-4);
  EXPECT_NEAR(c[5] / 32767.5 - 1.0, 0.0, 1e-4);
  EXPECT_NEAR(c[8] * json["depth_cell_m"].get<double>(), 0.25, 1e-5);
  EXPECT_EQ(json["marks"][0]["bodies"], (std::vector<int>{0, 4}));
  EXPECT_EQ(playbacks_json({two_cubes()}).find('<'), std::string::npos);
}

TEST(Playback, TurnsSurviveAndWhatTranslatesHasNone) {
  Playback p = two_cubes();
  EXPECT_EQ(nlohmann::json::parse(playbacks_json({p}))[0]["turns"], "");
  // By 90 degrees about y, and by 120 about (1, 1, 1).
  const float half = std::sqrt(0.5F);
  p.frames[0].turn = {{half, 0, half, 0}, {0.5F, 0.5F, 0.5F, 0.5F}};
  p.frames[1].turn = {{-1, 0, 0, 0}, {1, 0, 0, 0}};
  const std::vector<unsigned> words = words_of(nlohmann::json::parse(playbacks_json({p}))[0]["turns"]);
  const double expected[] = {half, 0, half, 0, 0.5, 0.5, 0.5, 0.5, -1, 0, 0, 0, 1, 0, 0, 0};
  ASSERT_EQ(words.size(), 16U);
  for (std::size_t k = 0; k < 16; ++k)
    EXPECT_NEAR(words[k] / 32767.5 - 1.0, expected[k], 0.51 / 32767.5) << k << ": half a cell, and its rounding";
}

TEST(Playback, ATurnedBodyIsDrawnTurned) {
  Playback p = two_cubes();
  p.shapes[0].levels[0][0] = {{-1, -0.1F, -0.1F}, {1, 0.1F, 0.1F}};
  p.frames.resize(1);
  p.frames[0].position = {{0, 0, 0}, {0, 0, 0}};
  // A rod along x; then, after a quarter of a turn about z, along y: the picture is taller.
  const std::string lying = playback_picture(p, -1);
  const float half = std::sqrt(0.5F);
  p.frames[0].turn = {{half, 0, 0, half}, {half, 0, 0, half}};
  const std::string standing = playback_picture(p, -1);
  const auto height_of = [](const std::string& svg) {
    const std::size_t at = svg.find("viewBox=\"0 0 720.0 ");
    return at == std::string::npos ? 0.0 : std::stod(svg.substr(at + 19));
  };
  ASSERT_GT(height_of(lying), 0.0) << lying;
  EXPECT_GT(height_of(standing), height_of(lying));
  EXPECT_EQ(testing_markup::check_markup(standing, false).problem, "");
}

TEST(Playback, WhatIsNotFiniteNeitherSpoilsTheOthersNorEndsTheProgram) {
  Playback p = two_cubes();
  p.frames[1].position[0] = {std::nanf(""), 1e30F, 0};
  p.frames[0].contacts[0].depth_m = std::nanf("");
  EXPECT_NO_FATAL_FAILURE(nlohmann::json::parse(playbacks_json({p})));
  EXPECT_NE(playback_picture(p, -1), "");
}

TEST(Playback, ThePictureIsSoundMarkupWithTheMarkedPairNamed) {
  const std::string svg = playback_picture(two_cubes(), 0);
  EXPECT_EQ(testing_markup::check_markup(svg, false).problem, "") << svg;
  EXPECT_NE(svg.find("body marked"), std::string::npos);
  EXPECT_NE(svg.find(">0</text>"), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  EXPECT_NE(svg.find("Step 3 of e"), std::string::npos);
  EXPECT_EQ(playback_picture({}, -1), "");
}

}  // namespace
}  // namespace broadside::reports
