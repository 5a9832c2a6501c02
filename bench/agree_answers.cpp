#include "bench/agree_answers.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <span>
#include <utility>

#include "bench/equivalence.hpp"
#include "bench/interrupt.hpp"
#include "bench/process_limits.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Bodies of one scene. A measure call takes a pose for every body of it, so few are cheap; but meshes that take long to
// load are better loaded seldom.
constexpr std::size_t kPairsPerScene = 64;
constexpr std::size_t kMeshPairsPerScene = 1024;
constexpr std::size_t kTextBytes = 1 << 16;

// What a child leaves behind whatever becomes of it: shared memory. Text is written before its size.
struct Report {
  std::uint64_t at = 0;     // the pair that is being asked about
  std::uint64_t begun = 0;  // rises with every query
  std::uint32_t text_size = 0;
  std::array<char, kTextBytes> text;
};

class SharedAnswers {
 public:
  explicit SharedAnswers(std::size_t count) : bytes_(sizeof(Report) + count * sizeof(Answer)), count_(count) {
    memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    report_ = new (memory_) Report;
    answers_ = new (static_cast<char*>(memory_) + sizeof(Report)) Answer[count];
  }
  SharedAnswers(const SharedAnswers&) = delete;
  SharedAnswers& operator=(const SharedAnswers&) = delete;
  ~SharedAnswers() { munmap(memory_, bytes_); }

  // Another process writes these: no compiler may believe that it knows them.
  [[nodiscard]] volatile Report& report() { return *report_; }
  [[nodiscard]] std::string text() const { return {report_->text.data(), report_->text_size}; }
  void set_text(const std::string& text) {
    const auto size = static_cast<std::uint32_t>(std::min(text.size(), kTextBytes));
    std::memcpy(report_->text.data(), text.data(), size);
    report_->text_size = size;
  }
  [[nodiscard]] Answer* answers() { return answers_; }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::size_t bytes_;
  std::size_t count_;
  void* memory_;
  Report* report_;
  Answer* answers_;
};

// Exit codes of a child that nobody killed.
constexpr int kAllAsked = 0;
constexpr int kRefused = 65;  // the engine or its scene: the report's text says why

core::Scene scene_of(const PairSource& source, std::span<const TestPair> pairs) {
  core::Scene scene;
  scene.name = "agree";
  scene.meshes = source.meshes();
  scene.domain = {{-100.0F, -100.0F, -100.0F}, {100.0F, 100.0F, 100.0F}};
  for (const TestPair& p : pairs) {
    for (const auto& [mesh, pose] : {std::pair{p.mesh_a, p.pose_a}, std::pair{p.mesh_b, p.pose_b}}) {
      core::Body body;
      body.mesh = mesh;
      body.position = pose.position;
      body.orientation = pose.orientation;
      scene.bodies.push_back(body);
    }
  }
  return scene;
}

// A child's whole life.
class Child {
 public:
  Child(core::Engine& engine, const PairSource& source, const std::vector<TestPair>& pairs, SharedAnswers& shared)
      : engine_(engine), source_(source), pairs_(pairs), shared_(shared) {}

  int live(std::size_t first) {
    const std::size_t most = source_.has_depth() ? kPairsPerScene : kMeshPairsPerScene;
    for (std::size_t k = first; k < pairs_.size(); k += most)
      if (!ask_scene(k, std::min(most, pairs_.size() - k))) return kRefused;
    return kAllAsked;
  }

 private:
  bool ask_scene(std::size_t first, std::size_t count) {
    const core::Scene scene = scene_of(source_, std::span(pairs_).subspan(first, count));
    if (core::Status s = engine_.narrow_phase->load(scene); !s) {
      shared_.set_text(s.error().line());
      return false;
    }
    std::vector<core::Pose> poses;
    for (const core::Body& body : scene.bodies) poses.push_back({body.position, body.orientation});
    for (std::uint32_t k = 0; k < count; ++k) ask_one({2 * k, 2 * k + 1}, poses, first + k);
    return true;
  }

  void ask_one(core::Pair pair, const std::vector<core::Pose>& poses, std::size_t index) {
    Answer& answer = shared_.answers()[index];
    shared_.report().at = index;
    shared_.report().begun = shared_.report().begun + 1;
    const auto start = Clock::now();
    const core::Status measured = engine_.narrow_phase->measure({&pair, 1}, poses);
    answer.seconds = std::chrono::duration<float>(Clock::now() - start).count();
    auto found = engine_.narrow_phase->read_back();
    const bool is_answered = measured.ok() && found.ok() && found.value().size() == 1;
    if (is_answered) answer.separation = found.value()[0];
    const std::string what = measured.ok() ? "no answer" : measured.error().what;
    if (!is_answered) what.copy(answer.thrown.data(), answer.thrown.size() - 1);
    answer.asked = is_answered ? Asked::kAnswered : Asked::kThrew;
  }

  core::Engine& engine_;
  const PairSource& source_;
  const std::vector<TestPair>& pairs_;
  SharedAnswers& shared_;
};

core::Result<core::Engine> make_engine(const CellSpec& cell) {
  auto settings = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
  if (!settings) return settings.error();
  auto engine = cell.row->create(settings.value());
  if (engine.ok() && engine.value().narrow_phase == nullptr)
    return core::Error{"it has no narrow phase", std::string(cell.row->id), "see 'broadside list engines'"};
  return engine;
}

struct Death {
  int status = 0;
  bool timed_out = false;
  std::string last_line;
};

// Reads what the child says until it ends; ends it when one query takes too long.
Death attend(pid_t child, int pipe_end, SharedAnswers& shared, double seconds_per_query,
             const std::function<void(std::uint64_t)>& progress) {
  Death death;
  std::string said;
  std::uint64_t begun = 0;
  auto since = Clock::now();
  std::array<char, 4096> buffer;
  for (;;) {
    pollfd waiting{pipe_end, POLLIN, 0};
    const int ready = poll(&waiting, 1, 100);
    if (shared.report().begun != begun) {
      begun = shared.report().begun;
      since = Clock::now();
      progress(shared.report().at);
    }
    if (is_interrupted()) kill(child, SIGKILL);
    if (!death.timed_out && std::chrono::duration<double>(Clock::now() - since).count() > seconds_per_query) {
      death.timed_out = true;
      kill(child, SIGKILL);
    }
    if (ready <= 0) continue;
    const ssize_t got = read(pipe_end, buffer.data(), buffer.size());
    if (got == 0 || (got < 0 && errno != EINTR)) break;
    if (got > 0) said.append(buffer.data(), static_cast<std::size_t>(got));
  }
  while (waitpid(child, &death.status, 0) < 0 && errno == EINTR) {
  }
  while (!said.empty() && said.back() == '\n') said.pop_back();
  death.last_line = said.substr(said.find_last_of('\n') + 1);
  return death;
}

// live() makes the child's exit code; the pipe carries its stderr.
template <typename Live>
core::Result<pid_t> spawn(std::uint64_t memory_mib, int& pipe_end, Live&& live) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0)
    return core::Error{std::string("no pipe: ") + std::strerror(errno), "agree", "", core::Exit::kInternal};
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    limit_this_process(memory_mib);
    // No destructors and no exit handlers: they belong to the parent.
    _exit(live());
  }
  close(ends[1]);
  pipe_end = ends[0];
  if (child < 0) {
    close(ends[0]);
    return core::Error{std::string("no child process: ") + std::strerror(errno), "agree", "", core::Exit::kInternal};
  }
  return child;
}

// What an engine says of itself, asked in a child too: making it may start what must not be forked.
int describe(const CellSpec& cell, const PairSource& source, SharedAnswers& shared) {
  auto engine = make_engine(cell);
  if (!engine) {
    shared.set_text(engine.error().line());
    return kRefused;
  }
  std::map<std::string, std::string> notes;
  core::add_notes(equivalence_of(engine.value(), scene_of(source, {})), notes);
  std::string text = engine.value().build + "\n";
  for (const auto& [key, value] : notes) text += key + "\t" + value + "\n";
  shared.set_text(text);
  return kAllAsked;
}

void take_description(const std::string& text, Answers& out) {
  out.build = text.substr(0, text.find('\n'));
  for (std::size_t at = out.build.size() + 1; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos) out.notes[line.substr(0, tab)] = line.substr(tab + 1);
    at = end + 1;
  }
}

// An assertion names its file by the whole path of the machine that built the library, which says nothing.
std::string without_path(const std::string& line) {
  const auto colon = line.find(": ");
  const auto slash = line.rfind('/', line.find(".h:") == std::string::npos ? line.find(".c") : line.find(".h:"));
  if (colon == std::string::npos || slash == std::string::npos) return line;
  return line.substr(slash + 1);
}

}  // namespace

core::Result<Answers> ask(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs,
                          const AskLimits& limits, const std::function<void(std::uint64_t)>& progress) {
  Answers out;
  SharedAnswers shared(pairs.size());
  bool is_described = false;
  for (std::size_t next = 0; next < pairs.size();) {
    int pipe_end = -1;
    auto child = spawn(limits.memory_mib, pipe_end, [&] {
      if (!is_described) return describe(cell, source, shared);
      auto engine = make_engine(cell);
      return engine ? Child(engine.value(), source, pairs, shared).live(next) : kRefused;
    });
    if (!child) return child.error();
    const Death death = attend(child.value(), pipe_end, shared, limits.seconds_per_query, progress);
    close(pipe_end);
    if (is_interrupted()) return core::Error{"interrupted", "agree", "", core::Exit::kMissing};
    if (WIFEXITED(death.status) && WEXITSTATUS(death.status) == kRefused)
      return core::Error{shared.text(), "", "", core::Exit::kMissing};
    const bool is_done = WIFEXITED(death.status) && WEXITSTATUS(death.status) == kAllAsked;
    if (!is_described) {
      if (!is_done) return core::Error{"it died when it was made", std::string(cell.row->id), "", core::Exit::kMissing};
      take_description(shared.text(), out);
      is_described = true;
      continue;
    }
    if (is_done) break;
    const std::uint64_t at = shared.report().at;
    const int signal = WIFSIGNALED(death.status) ? WTERMSIG(death.status) : 0;
    shared.answers()[at].asked = death.timed_out     ? Asked::kTimedOut
                                 : signal == SIGABRT ? Asked::kAborted
                                                     : Asked::kCrashed;
    ++out.words[death.timed_out           ? fmt::format("no answer within {} s", limits.seconds_per_query)
                : death.last_line.empty() ? fmt::format("signal {} ({})", signal, strsignal(signal))
                                          : without_path(death.last_line)];
    next = at + 1;
  }
  out.of_pair.assign(shared.answers(), shared.answers() + shared.count());
  for (const Answer& answer : out.of_pair)
    if (answer.asked == Asked::kThrew) ++out.words[answer.thrown.data()];
  return out;
}

}  // namespace broadside::bench
