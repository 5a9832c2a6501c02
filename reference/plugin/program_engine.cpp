#include "reference/plugin/program_engine.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/plugin/program_protocol.hpp"
#include "reference/plugin/program_process.hpp"

namespace broadside::reference {
namespace {

using core::Error;
using core::Exit;
using core::MessageWriter;
using core::Offers;
using core::ProgramCall;
using core::ProgramHello;
using core::Status;

// A running program and its last error.
class ProgramEngine {
 public:
  explicit ProgramEngine(ProgramProcess process) : process_(std::move(process)) {}

  // The answer's payload.
  core::Result<std::vector<std::byte>> ask(ProgramCall call, const MessageWriter& payload, std::uint64_t most_bytes) {
    if (payload.bytes().size() > 0xFFFFFFF0U)
      return Error{"its input has more than 4 GiB", "", "run a smaller scene", Exit::kMissing};
    if (Status s = process_.send(core::request(call, payload)); !s) return s.error();
    std::array<std::byte, 8> bytes{};
    // The length alone shows that the program printed some text into the protocol, also where nothing follows.
    if (Status s = process_.receive(std::span(bytes).first(4)); !s) return s.error();
    if (core::MessageReader(std::span(bytes).first(4)).get<std::uint32_t>() > most_bytes + core::kMostTextBytes + 8)
      return core::read_answer_head(bytes, most_bytes).error();
    if (Status s = process_.receive(std::span(bytes).last(4)); !s) return s.error();
    const auto head = core::read_answer_head(bytes, most_bytes);
    if (!head) return head.error();
    std::vector<std::byte> answer(head.value().payload_bytes);
    if (Status s = process_.receive(answer); !s) return s.error();
    if (!head.value().is_failure) return answer;
    core::MessageReader reader(answer);
    const std::string why = core::shown_text(reader.text(core::kMostTextBytes));
    return Error{why.empty() ? "it failed without a message" : why, "", "", Exit::kMissing};
  }

  // Makes a call of the table.
  int call(ProgramCall call, const MessageWriter& payload) {
    auto answer = ask(call, payload, 0);
    return answer.ok() ? BROADSIDE_OK : failed(answer.error());
  }

  template <typename Row>
  int read(ProgramCall call, Row* rows, std::uint64_t capacity, std::uint64_t* demanded) {
    auto answer = ask(call, MessageWriter().put(capacity), sizeof capacity + capacity * sizeof(Row));
    if (!answer) return failed(answer.error());
    auto read = core::read_rows_answer<Row>(answer.value(), capacity);
    if (!read) return failed(read.error());
    *demanded = read.value().demanded;
    std::copy(read.value().rows.begin(), read.value().rows.end(), rows);
    return BROADSIDE_OK;
  }

  // One row a body.
  template <typename Row>
  int read_bodies(ProgramCall call, Row* rows, std::uint32_t count) {
    std::uint64_t demanded = 0;
    if (read(call, rows, count, &demanded) != BROADSIDE_OK) return BROADSIDE_FAILED;
    if (demanded == count) return BROADSIDE_OK;
    return failed(
        {"it answers for " + std::to_string(demanded) + " bodies, and the scene has " + std::to_string(count)});
  }

  // The answer is empty, or the seconds of the step by the program's own clock.
  int step(double dt, bool tells_seconds) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    auto answer = ask(ProgramCall::kStep, MessageWriter().put(dt), tells_seconds ? sizeof(double) : 0);
    if (!answer) return failed(answer.error());
    const double whole = std::chrono::duration<double>(Clock::now() - start).count();
    if (!tells_seconds) return BROADSIDE_OK;
    core::MessageReader reader(answer.value());
    last_step_s_ = reader.get<double>();
    const bool is_possible = reader.is_read_whole() && last_step_s_ >= 0.0 && last_step_s_ <= whole;
    if (is_possible) return BROADSIDE_OK;
    return failed({"it says that the step took " + std::to_string(last_step_s_) + " s, and the call took " +
                   std::to_string(whole) + " s"});
  }

  [[nodiscard]] double last_step_s() const { return last_step_s_; }
  [[nodiscard]] const char* last_error() const { return error_.c_str(); }
  int failed(const Error& error) {
    error_ = error.advice.empty() ? error.what : error.what + "; " + error.advice;
    return BROADSIDE_FAILED;
  }

 private:
  ProgramProcess process_;
  double last_step_s_ = std::numeric_limits<double>::quiet_NaN();
  std::string error_;
};

struct Started {
  std::unique_ptr<ProgramEngine> engine;
  ProgramHello hello;
};

core::Result<Started> started(const std::vector<std::string>& words) {
  auto process = ProgramProcess::start(words);
  if (!process) return process.error();
  Started made{std::make_unique<ProgramEngine>(std::move(process).value()), {}};
  auto answer = made.engine->ask(ProgramCall::kHello, core::hello_request(), core::kMostHelloBytes);
  if (!answer) return Error{answer.error().what, "", answer.error().advice};
  auto hello = core::read_hello(answer.value());
  if (!hello) return hello.error();
  made.hello = std::move(hello).value();
  return made;
}

ProgramEngine& engine_of(void* self) {
  return *static_cast<ProgramEngine*>(self);
}

// Functions of the table that every program may have.
void add_functions(const ProgramHello& hello, broadside_engine2& t) {
  t.destroy = [](void* self) { delete static_cast<ProgramEngine*>(self); };
  t.last_error = [](void* self) { return self == nullptr ? "" : engine_of(self).last_error(); };
  t.end = [](void* self) { engine_of(self).call(ProgramCall::kEnd, {}); };
  if (hello.has(Offers::kBroadPhase)) {
    t.load_boxes = [](void* self, const broadside_box* boxes, const std::uint8_t* is_static, std::uint32_t n) {
      return engine_of(self).call(ProgramCall::kLoadBoxes,
                                  MessageWriter().put(n).rows(std::span(boxes, n)).rows(std::span(is_static, n)));
    };
    t.update_boxes = [](void* self, const broadside_box* boxes, std::uint32_t n) {
      return engine_of(self).call(ProgramCall::kUpdateBoxes, MessageWriter().put(n).rows(std::span(boxes, n)));
    };
    t.find_pairs = [](void* self) { return engine_of(self).call(ProgramCall::kFindPairs, {}); };
    t.read_pairs = [](void* self, broadside_pair* pairs, std::uint64_t capacity, std::uint64_t* demanded) {
      return engine_of(self).read(ProgramCall::kReadPairs, pairs, capacity, demanded);
    };
  }
  if (hello.has(Offers::kNarrowPhase)) {
    t.load_scene = [](void* self, const broadside_scene2* scene) {
      return engine_of(self).call(ProgramCall::kLoadScene, core::scene_request(*scene));
    };
    t.measure = [](void* self, const broadside_pair* pairs, std::uint64_t pair_count, const broadside_pose* poses,
                   std::uint32_t body_count) {
      return engine_of(self).call(ProgramCall::kMeasure, MessageWriter()
                                                             .put(pair_count)
                                                             .put(body_count)
                                                             .rows(std::span(pairs, pair_count))
                                                             .rows(std::span(poses, body_count)));
    };
    t.read_separations = [](void* self, broadside_separation* rows, std::uint64_t capacity, std::uint64_t* demanded) {
      return engine_of(self).read(ProgramCall::kReadSeparations, rows, capacity, demanded);
    };
  }
}

void add_dynamics(const ProgramHello& hello, broadside_engine2& t) {
  if (hello.has(Offers::kDynamics)) {
    t.begin = [](void* self, const broadside_scene2* scene) {
      return engine_of(self).call(ProgramCall::kBegin, core::scene_request(*scene));
    };
    if (hello.has(Offers::kStepSeconds))
      t.step = [](void* self, double dt) { return engine_of(self).step(dt, true); };
    else
      t.step = [](void* self, double dt) { return engine_of(self).step(dt, false); };
    t.read_states = [](void* self, broadside_state2* states, std::uint32_t n) {
      return engine_of(self).read_bodies(ProgramCall::kReadStates, states, n);
    };
  }
  if (hello.has(Offers::kPoints))
    t.read_points = [](void* self, broadside_point* points, std::uint64_t capacity, std::uint64_t* demanded) {
      return engine_of(self).read(ProgramCall::kReadPoints, points, capacity, demanded);
    };
  if (hello.has(Offers::kContacts))
    t.read_contacts = [](void* self, broadside_contact* contacts, std::uint64_t capacity, std::uint64_t* demanded) {
      return engine_of(self).read(ProgramCall::kReadContacts, contacts, capacity, demanded);
    };
  if (hello.has(Offers::kDetection))
    t.read_detection = [](void* self, broadside_detection* seen, std::uint32_t n) {
      return engine_of(self).read_bodies(ProgramCall::kReadDetection, seen, n);
    };
  if (hello.has(Offers::kStepPairs))
    t.read_step_pairs = [](void* self, broadside_pair* pairs, std::uint64_t capacity, std::uint64_t* demanded) {
      return engine_of(self).read(ProgramCall::kReadStepPairs, pairs, capacity, demanded);
    };
}

class ProgramSource final : public PluginSource {
 public:
  ProgramSource(std::vector<std::string> words, Started first)
      : words_(std::move(words)), hello_(std::move(first.hello)), spare_(std::move(first.engine)) {
    table_.abi = BROADSIDE_ENGINE_ABI_2;
    table_.size = sizeof table_;
    table_.id = hello_.id.c_str();
    table_.build = hello_.build.c_str();
    table_.what = hello_.what.c_str();
    table_.memory = BROADSIDE_HOST;
    table_.is_exact = hello_.is_exact ? 1 : 0;
    table_.margin_m = hello_.margin_m;
    for (const auto& s : hello_.settings) settings_.push_back({s.key.c_str(), s.default_value, s.what.c_str()});
    for (const auto& d : hello_.declared) declared_.push_back({d.key.c_str(), d.value.c_str()});
    table_.settings = settings_.data();
    table_.setting_count = static_cast<std::uint32_t>(settings_.size());
    table_.declared = declared_.data();
    table_.declared_count = static_cast<std::uint32_t>(declared_.size());
    // Programs are started by create() below, which knows the command.
    table_.create = [](const std::uint64_t*) -> void* { return nullptr; };
    add_functions(hello_, table_);
    add_dynamics(hello_, table_);
  }

  [[nodiscard]] const broadside_engine2& table() const override { return table_; }
  [[nodiscard]] bool is_behind_a_pipe() const override { return true; }
  [[nodiscard]] bool tells_step_seconds() const override { return hello_.has(Offers::kStepSeconds); }
  [[nodiscard]] double last_step_s(void* self) const override { return engine_of(self).last_step_s(); }

  [[nodiscard]] core::Result<void*> create(const std::vector<std::uint64_t>& values) const override {
    std::unique_ptr<ProgramEngine> engine = std::move(spare_);
    if (engine == nullptr) {
      auto again = started(words_);
      if (!again) return at("create", again.error());
      if (again.value().hello != hello_)
        return at("create", {"it describes itself differently at its second start", "", "", Exit::kMissing});
      engine = std::move(again.value().engine);
    }
    MessageWriter message;
    message.put(static_cast<std::uint32_t>(values.size())).rows(std::span<const std::uint64_t>(values));
    auto answer = engine->ask(ProgramCall::kCreate, message, 0);
    if (!answer) return at("create", answer.error());
    return static_cast<void*>(engine.release());
  }

 private:
  [[nodiscard]] Error at(const char* call, Error error) const {
    error.where = hello_.id + ": " + call;
    error.exit = Exit::kMissing;
    return error;
  }

  std::vector<std::string> words_;
  ProgramHello hello_;
  // The program that said hello is the first instance.
  mutable std::unique_ptr<ProgramEngine> spare_;
  std::vector<broadside_setting> settings_;
  std::vector<broadside_declared> declared_;
  broadside_engine2 table_{};
};

}  // namespace

core::Result<std::shared_ptr<const PluginSource>> open_program(std::string_view command) {
  const auto at = [&](Error error) {
    error.where = command;
    return error;
  };
  auto words = words_of(command);
  if (!words) return at(words.error());
  auto first = started(words.value());
  if (!first) return at(first.error());
  auto source = std::make_shared<ProgramSource>(std::move(words).value(), std::move(first).value());
  if (std::string fault = fault_of(source->table()); !fault.empty())
    return at({fault, "", "core/plugin/PROGRAMS.md says what an answer to hello holds"});
  return std::shared_ptr<const PluginSource>(std::move(source));
}

}  // namespace broadside::reference
