// The protocol of program engines, byte by byte as core/plugin/PROGRAMS.md has it. Expected bytes are written here by
// hand.
#include "core/plugin/program_protocol.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace broadside::core {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

// Texts with zeros in them.
template <std::size_t N>
std::string raw(const char (&text)[N]) {
  return {text, N - 1};
}

std::string text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::string kZero8(8, '\0');

std::string good_hello() {
  return raw("BROADSID\x01\0\0\0\x0c\0\0\0\x01\0\0\0") + kZero8 + raw("\x02\0\0\0me") +
         raw("\x03\0\0\0"
             "1.0") +
         raw("\x04\0\0\0line") + raw("\x01\0\0\0\x04\0\0\0cell\xfa\0\0\0\0\0\0\0\x04\0\0\0edge") +
         raw("\x01\0\0\0\x06\0\0\0motion\x05\0\0\0rigid");
}

std::string refusal(const std::string& payload) {
  const auto hello = read_hello(bytes_of(payload));
  return hello.ok() ? "accepted" : hello.error().line();
}

TEST(ProgramProtocol, ARequestIsItsLengthItsCallAndItsPayload) {
  EXPECT_EQ(text_of(request(ProgramCall::kHello, hello_request())),
            raw("\x14\0\0\0\x01\0\0\0BROADSID\x01\0\0\0\x01\0\0\0"));
  EXPECT_EQ(text_of(request(ProgramCall::kStep, MessageWriter().put(0.5))),
            raw("\x0c\0\0\0\x0b\0\0\0\0\0\0\0\0\0\xe0\x3f"));
  EXPECT_EQ(call_word(ProgramCall::kReadStepPairs), "read_step_pairs");
}

TEST(ProgramProtocol, AHelloIsRead) {
  const auto hello = read_hello(bytes_of(good_hello()));
  ASSERT_TRUE(hello.ok()) << hello.error().line();
  EXPECT_EQ(hello.value().id, "me");
  EXPECT_EQ(hello.value().build, "1.0");
  EXPECT_EQ(hello.value().what, "line");
  EXPECT_TRUE(hello.value().has(Offers::kDynamics));
  EXPECT_TRUE(hello.value().has(Offers::kPoints));
  EXPECT_FALSE(hello.value().has(Offers::kBroadPhase));
  ASSERT_EQ(hello.value().settings.size(), 1U);
  EXPECT_EQ(hello.value().settings[0], (ProgramHello::Setting{"cell", 250, "edge"}));
  ASSERT_EQ(hello.value().declared.size(), 1U);
  EXPECT_EQ(hello.value().declared[0], (ProgramHello::Declared{"motion", "rigid"}));
}

TEST(ProgramProtocol, AHelloCutAnywhereOrLongerIsRefusedInOneLine) {
  const std::string good = good_hello();
  for (std::size_t size = 0; size < good.size(); ++size) {
    const std::string line = refusal(good.substr(0, size));
    EXPECT_NE(line, "accepted") << size;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_NE(refusal(good + "x").find("is too long by 1 bytes"), std::string::npos);
  std::string of_nine = good;
  of_nine[8] = 9;
  EXPECT_NE(refusal(of_nine).find("it speaks version 9"), std::string::npos);
  std::string of_two = good;
  of_two[16] = 2;
  EXPECT_NE(refusal(of_two).find("is_exact of its answer to hello is neither 0 nor 1"), std::string::npos);
  std::string of_less = good;
  const double less = -1.0;
  std::memcpy(&of_less[20], &less, sizeof less);
  EXPECT_NE(refusal(of_less).find("margin_m"), std::string::npos);
}

TEST(ProgramProtocol, ACountThatLiesTakesNoMemory) {
  EXPECT_NE(refusal(raw("BROADSID\x01\0\0\0\x0c\0\0\0\x01\0\0\0") + kZero8 + raw("\xff\xff\xff\xff"))
                .find("ends in the middle"),
            std::string::npos);
  MessageReader reader(Bytes(16));
  EXPECT_TRUE(reader.rows<broadside_state2>(std::numeric_limits<std::uint64_t>::max()).empty());
  EXPECT_TRUE(reader.failed());
}

TEST(ProgramProtocol, AnAnswersHeadSaysHowMuchFollows) {
  const auto head = [](const std::string& text, std::uint64_t most) {
    const Bytes bytes = bytes_of(text);
    return read_answer_head(std::span<const std::byte, 8>(bytes.data(), 8), most);
  };
  const auto good = head(raw("\x0c\0\0\0\0\0\0\0"), 8);
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(good.value().payload_bytes, 8U);
  EXPECT_FALSE(good.value().is_failure);
  EXPECT_TRUE(head(raw("\x0c\0\0\0\x01\0\0\0"), 0).value().is_failure) << "a failure has a text, whatever was asked";
  EXPECT_FALSE(head(raw("\x0d\0\0\0\0\0\0\0"), 8).ok()) << "a byte too many";
  EXPECT_FALSE(head(raw("\x03\0\0\0\0\0\0\0"), 8).ok()) << "not even a status";
  EXPECT_FALSE(head(raw("\x0c\0\0\0\x02\0\0\0"), 8).ok()) << "status 2";
  EXPECT_NE(head("Hello, I", 8).error().line().find("the bytes 'Hello, I'"), std::string::npos);
}

TEST(ProgramProtocol, RowsAreAsManyAsTheirCountAndTheRoomSay) {
  const std::string two = raw("\x02\0\0\0\0\0\0\0\x01\0\0\0\x02\0\0\0\x03\0\0\0\x04\0\0\0");
  const auto rows = read_rows_answer<broadside_pair>(bytes_of(two), 5);
  ASSERT_TRUE(rows.ok());
  ASSERT_EQ(rows.value().rows.size(), 2U);
  EXPECT_EQ(rows.value().rows[1].i, 3U);
  EXPECT_FALSE(read_rows_answer<broadside_pair>(bytes_of(two), 1).ok()) << "more than there was room for";
  const auto first = read_rows_answer<broadside_pair>(bytes_of(two.substr(0, 16)), 1);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first.value().demanded, 2U) << "the caller comes again with room for two";
  EXPECT_FALSE(read_rows_answer<broadside_pair>(bytes_of(two.substr(0, 20)), 5).ok()) << "half a row";
  EXPECT_FALSE(read_rows_answer<broadside_pair>(bytes_of("1234567"), 5).ok()) << "no count";
}

// A scene with one triangle: each number is at the place that the page gives for it.
TEST(ProgramProtocol, ASceneIsSentAsThePageSays) {
  const float vertices[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t triangle[3] = {0, 1, 2};
  const broadside_mesh mesh{vertices, 3, triangle, 1};
  broadside_shape shape{};
  shape.kind = BROADSIDE_CONVEX;
  broadside_body2 body{};
  body.mass = 3.0;
  broadside_wrench wrench{};
  wrench.torque[2] = 7.0;
  broadside_scene2 scene{};
  scene.name = "s";
  scene.motion = BROADSIDE_RIGID;
  scene.frames = 60;
  scene.seed = 9;
  scene.dt = 0.25;
  scene.theta = 0.125;
  scene.meshes = &mesh;
  scene.shapes = &shape;
  scene.bodies = &body;
  scene.wrenches = &wrench;
  scene.mesh_count = scene.body_count = scene.wrench_count = 1;
  const MessageWriter message = scene_request(scene);
  MessageReader r(message.bytes());
  EXPECT_EQ(r.text(10), "s");
  EXPECT_EQ(r.get<std::uint32_t>(), 1U);
  EXPECT_EQ(r.get<std::uint32_t>(), 60U);
  EXPECT_EQ(r.get<std::uint64_t>(), 9U);
  EXPECT_EQ(r.get<double>(), 0.25);
  EXPECT_EQ(r.rows<double>(3 + 3 + 3 + 3 + 3).size(), 15U);  // gravity, domain, face, delta, v_threshold, v_max
  EXPECT_EQ(r.get<double>(), 0.125);
  EXPECT_EQ(r.rows<std::uint32_t>(3), (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(r.get<broadside_shape>().kind, static_cast<std::uint32_t>(BROADSIDE_CONVEX));
  EXPECT_EQ(r.get<broadside_body2>().mass, 3.0);
  EXPECT_EQ(r.get<broadside_wrench>().torque[2], 7.0);
  EXPECT_EQ(r.rows<std::uint64_t>(2), (std::vector<std::uint64_t>{3, 1}));
  EXPECT_EQ(r.rows<float>(9)[7], 1.0F);
  EXPECT_EQ(r.rows<std::uint32_t>(3)[2], 2U);
  EXPECT_TRUE(r.is_read_whole());
}

TEST(ProgramProtocol, TextIsShownInOneLineOfUtf8) {
  EXPECT_EQ(shown_text("plain \xc3\xa4"), "plain \xc3\xa4");
  EXPECT_EQ(shown_text("two\nlines\t\x1b[31m"), "two lines  [31m");
  EXPECT_EQ(shown_text("\xff\xc3"), "??");
  EXPECT_EQ(shown_text("\xc0\x80"), "??") << "an overlong zero";
  EXPECT_EQ(shown_text("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_FALSE(is_plain_text("a\nb"));
  EXPECT_TRUE(is_plain_text("\xe2\x82\xac \xf0\x9f\x8c\x95"));
}

}  // namespace
}  // namespace broadside::core
