// The requests to an engine that is a program, and its answers: PROGRAMS.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin/broadside_engine_v2.h"
#include "core/plugin/message.hpp"
#include "core/result.hpp"

namespace broadside::core {

inline constexpr std::string_view kProtocolMagic = "BROADSID";
inline constexpr std::uint32_t kProtocolVersion = 1;
inline constexpr std::uint32_t kAnswerOk = 0;
inline constexpr std::uint32_t kAnswerFailed = 1;
// Limits in bytes: an answer to hello, and the text of a failure.
inline constexpr std::uint32_t kMostHelloBytes = 1U << 20U;
inline constexpr std::uint32_t kMostTextBytes = 4096;

// The functions of broadside_engine2. destroy has no call: closing the program's input stands for it.
enum class ProgramCall : std::uint32_t {
  kHello = 1,
  kCreate = 2,
  kLoadBoxes = 3,
  kUpdateBoxes = 4,
  kFindPairs = 5,
  kReadPairs = 6,
  kLoadScene = 7,
  kMeasure = 8,
  kReadSeparations = 9,
  kBegin = 10,
  kStep = 11,
  kReadStates = 12,
  kReadPoints = 13,
  kReadContacts = 14,
  kReadDetection = 15,
  kReadStepPairs = 16,
  kEnd = 17,
};

// The function's name, such as "read_points".
std::string_view call_word(ProgramCall call);

// Bits of ProgramHello::offers.
enum class Offers : std::uint32_t {
  kBroadPhase = 1U << 0,
  kNarrowPhase = 1U << 1,
  kDynamics = 1U << 2,
  kPoints = 1U << 3,
  kContacts = 1U << 4,
  kDetection = 1U << 5,
  kStepPairs = 1U << 6,
  kStepSeconds = 1U << 7,  // answers to step contain the time that it took by the program's own clock
};

// What a program declares about itself: the same as the table of broadside_engine2.
struct ProgramHello {
  struct Setting {
    std::string key;
    std::uint64_t default_value = 0;
    std::string what;
    friend bool operator==(const Setting&, const Setting&) = default;
  };
  struct Declared {
    std::string key;
    std::string value;
    friend bool operator==(const Declared&, const Declared&) = default;
  };
  std::uint32_t offers = 0;
  bool is_exact = true;
  double margin_m = 0.0;
  std::string id;
  std::string build;
  std::string what;
  std::vector<Setting> settings;
  std::vector<Declared> declared;

  [[nodiscard]] bool has(Offers bit) const { return (offers & static_cast<std::uint32_t>(bit)) != 0; }
  friend bool operator==(const ProgramHello&, const ProgramHello&) = default;
};

// The length of what follows, then the call and its payload.
std::vector<std::byte> request(ProgramCall call, const MessageWriter& payload);

MessageWriter hello_request();
// The error says which part is wrong. `payload`: the bytes after the status.
Result<ProgramHello> read_hello(std::span<const std::byte> payload);

MessageWriter scene_request(const broadside_scene2& scene);

// The first eight bytes of an answer: u32 length of the rest, u32 status.
struct AnswerHead {
  std::uint32_t payload_bytes = 0;
  bool is_failure = false;
};
// most_bytes: the largest payload of a good answer.
Result<AnswerHead> read_answer_head(std::span<const std::byte, 8> head, std::uint64_t most_bytes);

// Reads the answer of a call that reads rows: u64 number of rows, then at most `capacity` of them.
template <MessageRow T>
struct AnsweredRows {
  std::uint64_t demanded = 0;
  std::vector<T> rows;
};
template <MessageRow T>
Result<AnsweredRows<T>> read_rows_answer(std::span<const std::byte> payload, std::uint64_t capacity) {
  MessageReader reader(payload);
  AnsweredRows<T> answered;
  answered.demanded = reader.get<std::uint64_t>();
  const std::uint64_t count = answered.demanded < capacity ? answered.demanded : capacity;
  if (!reader.failed() && reader.left() != count * sizeof(T))
    return Error{"its answer has " + std::to_string(reader.left()) + " bytes, and " + std::to_string(count) +
                     " rows of " + std::to_string(sizeof(T)) + " bytes were due",
                 "", "", Exit::kMissing};
  answered.rows = reader.rows<T>(count);
  if (!reader.is_read_whole()) return Error{"its answer has no count", "", "", Exit::kMissing};
  return answered;
}

// Text of a program or a library, made safe to show: one line of valid UTF-8 without control characters.
std::string shown_text(std::string_view text);
bool is_plain_text(std::string_view text);

}  // namespace broadside::core
