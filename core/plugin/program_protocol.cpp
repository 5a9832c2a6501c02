#include "core/plugin/program_protocol.hpp"

#include <array>
#include <cmath>
#include <string>

namespace broadside::core {
namespace {

constexpr std::string_view kAdvice =
    "write only the protocol to standard output, and text for people to standard error";

// These structs have no padding, so the bytes that are sent are those that PROGRAMS.md lists.
static_assert(sizeof(broadside_box) == 24 && sizeof(broadside_pair) == 8 && sizeof(broadside_pose) == 28);
static_assert(sizeof(broadside_separation) == 48 && sizeof(broadside_contact) == 140);
static_assert(sizeof(broadside_state2) == 104 && sizeof(broadside_point) == 96 && sizeof(broadside_detection) == 104);
static_assert(sizeof(broadside_shape) == 48 && sizeof(broadside_body2) == 216 && sizeof(broadside_wrench) == 56);

// Lists in a hello are short: a longer one means a wrong count.
constexpr std::uint32_t kMostListed = 256;

Error garbled(std::string what) {
  return {std::move(what), "", std::string(kAdvice), Exit::kBadInput};
}

// Length of the UTF-8 character at the beginning of the text; 0 when there is none. RFC 3629.
std::size_t utf8_length(std::string_view text) {
  const auto at = [text](std::size_t k) { return static_cast<unsigned char>(k < text.size() ? text[k] : 0); };
  const auto follows = [&](std::size_t k) { return (at(k) & 0xC0U) == 0x80U; };
  const unsigned first = at(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF && follows(1)) return 2;
  const bool is_overlong = (first == 0xE0 && at(1) < 0xA0) || (first == 0xF0 && at(1) < 0x90);
  const bool is_surrogate = first == 0xED && at(1) >= 0xA0;
  const bool is_beyond = first == 0xF4 && at(1) >= 0x90;
  if (is_overlong || is_surrogate || is_beyond) return 0;
  if (first >= 0xE0 && first <= 0xEF && follows(1) && follows(2)) return 3;
  if (first >= 0xF0 && first <= 0xF4 && follows(1) && follows(2) && follows(3)) return 4;
  return 0;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

}  // namespace

std::string_view call_word(ProgramCall call) {
  constexpr std::array<std::string_view, 18> kWords{"",
                                                    "hello",
                                                    "create",
                                                    "load_boxes",
                                                    "update_boxes",
                                                    "find_pairs",
                                                    "read_pairs",
                                                    "load_scene",
                                                    "measure",
                                                    "read_separations",
                                                    "begin",
                                                    "step",
                                                    "read_states",
                                                    "read_points",
                                                    "read_contacts",
                                                    "read_detection",
                                                    "read_step_pairs",
                                                    "end"};
  return kWords.at(static_cast<std::size_t>(call));
}

std::vector<std::byte> request(ProgramCall call, const MessageWriter& payload) {
  MessageWriter frame;
  frame.put(static_cast<std::uint32_t>(payload.bytes().size() + sizeof(std::uint32_t)));
  frame.put(static_cast<std::uint32_t>(call));
  frame.rows(std::span<const std::byte>(payload.bytes()));
  return frame.bytes();
}

MessageWriter hello_request() {
  MessageWriter message;
  message.rows(std::span<const char>(kProtocolMagic.data(), kProtocolMagic.size()));
  message.put(kProtocolVersion).put(kProtocolVersion);  // lowest and highest version supported here
  return message;
}

Result<ProgramHello> read_hello(std::span<const std::byte> payload) {
  MessageReader reader(payload);
  const std::vector<char> magic = reader.rows<char>(kProtocolMagic.size());
  if (reader.failed() || std::string_view(magic.data(), magic.size()) != kProtocolMagic)
    return garbled("its answer to hello does not begin with " + std::string(kProtocolMagic));
  const auto version = reader.get<std::uint32_t>();
  if (version != kProtocolVersion)
    return Error{"it speaks version " + std::to_string(version) + " of the protocol, but this program speaks version " +
                     std::to_string(kProtocolVersion),
                 "", "answer hello with a version from its lowest to its highest", Exit::kBadInput};
  ProgramHello hello;
  hello.offers = reader.get<std::uint32_t>();
  const auto is_exact = reader.get<std::uint32_t>();
  hello.is_exact = is_exact == 1;
  hello.margin_m = reader.get<double>();
  hello.id = reader.text(kMostTextBytes);
  hello.build = reader.text(kMostTextBytes);
  hello.what = reader.text(kMostTextBytes);
  const auto settings = reader.get<std::uint32_t>();
  for (std::uint32_t k = 0; k < settings && k <= kMostListed && !reader.failed(); ++k) {
    ProgramHello::Setting setting;
    setting.key = reader.text(kMostTextBytes);
    setting.default_value = reader.get<std::uint64_t>();
    setting.what = reader.text(kMostTextBytes);
    hello.settings.push_back(std::move(setting));
  }
  const auto declared = reader.get<std::uint32_t>();
  for (std::uint32_t k = 0; k < declared && k <= kMostListed && !reader.failed(); ++k) {
    ProgramHello::Declared one;
    one.key = reader.text(kMostTextBytes);
    one.value = reader.text(kMostTextBytes);
    hello.declared.push_back(std::move(one));
  }
  if (!reader.is_read_whole())
    return garbled(reader.failed() ? "its answer to hello ends in the middle of a value"
                                   : "its answer to hello is too long by " + std::to_string(reader.left()) + " bytes");
  if (is_exact > 1) return garbled("is_exact of its answer to hello is neither 0 nor 1");
  if (!std::isfinite(hello.margin_m) || hello.margin_m < 0.0)
    return garbled("margin_m of its answer to hello is not a finite number of 0 or more");
  return hello;
}

MessageWriter scene_request(const broadside_scene2& s) {
  MessageWriter message;
  message.text(s.name).put(s.motion).put(s.frames).put(s.seed);
  message.put(s.dt).put(s.gravity).put(s.domain_min).put(s.domain_max);
  message.put(s.face_mu_static).put(s.face_mu_kinetic).put(s.face_restitution);
  message.put(s.delta).put(s.v_threshold).put(s.v_max).put(s.theta);
  message.put(s.mesh_count).put(s.body_count).put(s.wrench_count);
  message.rows(std::span(s.shapes, s.mesh_count));
  message.rows(std::span(s.bodies, s.body_count));
  message.rows(std::span(s.wrenches, s.wrench_count));
  for (const broadside_mesh& mesh : std::span(s.meshes, s.mesh_count)) {
    message.put(mesh.vertex_count).put(mesh.triangle_count);
    message.rows(std::span(mesh.vertices, 3 * mesh.vertex_count));
    message.rows(std::span(mesh.triangles, 3 * mesh.triangle_count));
  }
  return message;
}

Result<AnswerHead> read_answer_head(std::span<const std::byte, 8> head, std::uint64_t most_bytes) {
  MessageReader reader(head);
  const auto length = reader.get<std::uint32_t>();
  const auto status = reader.get<std::uint32_t>();
  const bool is_known = status == kAnswerOk || status == kAnswerFailed;
  const std::uint64_t most = status == kAnswerFailed ? kMostTextBytes + sizeof(std::uint32_t) : most_bytes;
  if (length >= sizeof status && is_known && length - sizeof status <= most)
    return AnswerHead{static_cast<std::uint32_t>(length - sizeof status), status == kAnswerFailed};
  const std::string_view seen(reinterpret_cast<const char*>(head.data()), head.size());
  return garbled("its answer begins with the bytes '" + shown_text(seen) + "', which are not a length of at most " +
                 std::to_string(most_bytes + sizeof status) + " and a status of 0 or 1");
}

std::string shown_text(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0 || (length == 1 && is_control(text[0])))
      shown += length == 0 ? '?' : ' ';
    else
      shown += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return shown;
}

bool is_plain_text(std::string_view text) {
  return shown_text(text) == text;
}

}  // namespace broadside::core
