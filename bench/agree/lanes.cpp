#include "bench/agree/lanes.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/process/interrupt.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/process/shared_array.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Processor seconds for making an engine and its shapes: trees of 700,000 triangles take some ten seconds.
constexpr double kLoad_s = 600.0;
// A query that blocks uses no processor time, so this much elapsed time beyond the limit ends it too.
constexpr double kAsleep_s = 60.0;

double processor_seconds_of(pid_t process) {
  clockid_t clock{};
  timespec t{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0.0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// An assertion names its source file by the path on the machine that built the library; that path is cut off.
std::string without_path(const std::string& line) {
  const auto colon = line.find(": ");
  const auto slash = line.rfind('/', line.find(".h:") == std::string::npos ? line.find(".c") : line.find(".h:"));
  if (colon == std::string::npos || slash == std::string::npos) return line;
  return line.substr(slash + 1);
}

// A child process that works on a range of pairs. When it dies, a new one continues with the pair after the one at
// which it died.
class Lane {
 public:
  Lane(std::size_t first, std::size_t last) : next_(first), last_(last), report_(1) {}
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;
  ~Lane() {
    if (pipe_end_ >= 0) close(pipe_end_);
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }

  core::Status spawn(std::uint64_t memory_mib, const LiveChild& live) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return no_process("no pipe");
    const pid_t parent = getpid();
    child_ = fork();
    if (child_ == 0) {
      die_with(parent);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      limit_this_process(memory_mib);
      // _exit runs no destructors and no exit handlers: they belong to the parent.
      _exit(live(report_[0], next_, last_));
    }
    close(ends[1]);
    pipe_end_ = ends[0];
    if (child_ < 0) return no_process("no child process");
    said_.clear();
    timed_out_ = false;
    mark();
    return core::Done{};
  }

  // Ends the child when its current step takes too long.
  void watch(double seconds_per_query) {
    if (report().begun != begun_) mark();
    if (timed_out_) return;
    const double limit = report().is_querying ? seconds_per_query : kLoad_s;
    const double elapsed = std::chrono::duration<double>(Clock::now() - since_).count();
    if (processor_seconds_of(child_) - used_ < limit && elapsed < kAsleep_s + 10.0 * limit) return;
    timed_out_ = true;
    kill(child_, SIGKILL);
  }

  // Reads what the child writes to stderr. True when it has ended; then fate() and last_words() say how.
  bool listen() {
    std::array<char, 4096> buffer;
    const ssize_t got = read(pipe_end_, buffer.data(), buffer.size());
    if (got > 0) said_.append(buffer.data(), static_cast<std::size_t>(got));
    if (got > 0 || (got < 0 && errno == EINTR)) return false;
    close(std::exchange(pipe_end_, -1));
    while (waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    while (!said_.empty() && said_.back() == '\n') said_.pop_back();
    return true;
  }

  [[nodiscard]] bool ended_with(int exit_code) const { return WIFEXITED(status_) && WEXITSTATUS(status_) == exit_code; }
  [[nodiscard]] bool died_in_a_query() { return report().is_querying; }

  // How the process ended: this is the answer for the pair that it was measuring.
  [[nodiscard]] Asked fate() const {
    if (timed_out_) return Asked::kTimedOut;
    return WIFSIGNALED(status_) && WTERMSIG(status_) == SIGABRT ? Asked::kAborted : Asked::kCrashed;
  }
  [[nodiscard]] std::string last_words(double seconds_per_query) const {
    if (timed_out_) return fmt::format("no answer within {} s", seconds_per_query);
    const std::string line = said_.substr(said_.find_last_of('\n') + 1);
    const int signal = WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
    return line.empty() ? fmt::format("signal {} ({})", signal, strsignal(signal))  // NOLINT(concurrency-mt-unsafe)
                        : without_path(line);
  }

  void go_on_behind(std::uint64_t pair) { next_ = pair + 1; }
  [[nodiscard]] bool has_more() const { return next_ < last_; }
  [[nodiscard]] std::uint64_t at() { return report().at; }
  [[nodiscard]] std::uint64_t remaining() { return last_ - std::clamp<std::size_t>(at(), next_, last_); }
  [[nodiscard]] std::string said() { return report_[0].said(); }
  [[nodiscard]] int pipe_end() const { return pipe_end_; }

 private:
  // Written by another process: volatile keeps the compiler from caching it.
  volatile ChildReport& report() { return report_[0]; }

  void mark() {
    begun_ = report().begun;
    since_ = Clock::now();
    used_ = processor_seconds_of(child_);
  }

  static core::Error no_process(const char* what) {
    return {std::string(what) + ": " + std::generic_category().message(errno), "agree", "", core::Exit::kInternal};
  }

  std::size_t next_;
  std::size_t last_;
  SharedArray<ChildReport> report_;
  pid_t child_ = -1;
  int pipe_end_ = -1;
  int status_ = 0;
  std::uint64_t begun_ = 0;
  Clock::time_point since_;
  double used_ = 0.0;
  bool timed_out_ = false;
  std::string said_;
};

// Waits until a child writes something or ends, but never so long that a query runs far beyond its limit.
std::vector<Lane*> wait_for(std::vector<std::unique_ptr<Lane>>& lanes, double seconds_per_query) {
  std::vector<pollfd> waiting;
  for (const auto& lane : lanes)
    if (lane->pipe_end() >= 0) waiting.push_back({lane->pipe_end(), POLLIN, 0});
  poll(waiting.data(), waiting.size(), static_cast<int>(std::clamp(250.0 * seconds_per_query, 1.0, 100.0)));
  std::vector<Lane*> ready;
  for (const auto& lane : lanes)
    for (const pollfd& p : waiting)
      if (p.fd == lane->pipe_end() && p.revents != 0) ready.push_back(lane.get());
  return ready;
}

}  // namespace

void ChildReport::say(const std::string& words) {
  const auto size = static_cast<std::uint32_t>(std::min(words.size(), text.size()));
  std::memcpy(text.data(), words.data(), size);
  text_size = size;
}

void ChildReport::begin(std::size_t place, bool queries) {
  volatile ChildReport& seen = *this;
  seen.at = place;
  seen.is_querying = queries;
  seen.begun = seen.begun + 1;
}

core::Result<std::string> said_by_child(std::string_view engine, const AskLimits& limits,
                                        const std::function<int(ChildReport&)>& live) {
  std::vector<std::unique_ptr<Lane>> lanes;
  lanes.push_back(std::make_unique<Lane>(0, 0));
  Lane& lane = *lanes.front();
  if (core::Status s =
          lane.spawn(limits.memory_mib, [&](ChildReport& report, std::size_t, std::size_t) { return live(report); });
      !s)
    return s.error();
  while (wait_for(lanes, limits.seconds_per_query).empty() || !lane.listen()) lane.watch(limits.seconds_per_query);
  if (lane.ended_with(kRefused)) return core::Error{lane.said(), "", "", core::Exit::kMissing};
  if (!lane.ended_with(kAllAsked))
    return core::Error{"it died while it was created: " + lane.last_words(kLoad_s), std::string(engine), "",
                       core::Exit::kMissing};
  return lane.said();
}

core::Status ask_in_children(std::string_view engine, std::size_t questions, const AskLimits& limits,
                             const LiveChild& live, const OnDeath& on_death,
                             const std::function<void(std::uint64_t)>& progress) {
  std::vector<std::unique_ptr<Lane>> lanes;
  const std::size_t count = std::clamp<std::size_t>(limits.processes, 1, std::max<std::size_t>(1, questions));
  for (std::size_t k = 0; k < count; ++k) {
    lanes.push_back(std::make_unique<Lane>(k * questions / count, (k + 1) * questions / count));
    if (core::Status s = lanes.back()->spawn(limits.memory_mib, live); !s) return s.error();
  }
  while (!lanes.empty()) {
    const std::vector<Lane*> ready = wait_for(lanes, limits.seconds_per_query);
    if (is_interrupted()) return core::Error{"interrupted", "agree", "", core::Exit::kMissing};
    std::uint64_t done = questions;
    for (const auto& lane : lanes) {
      lane->watch(limits.seconds_per_query);
      done -= lane->remaining();
    }
    progress(done);
    for (Lane* lane : ready) {
      if (!lane->listen()) continue;
      if (lane->ended_with(kRefused)) return core::Error{lane->said(), "", "", core::Exit::kMissing};
      bool is_done = lane->ended_with(kAllAsked);
      if (!is_done) {
        const std::string words = lane->last_words(limits.seconds_per_query);
        if (!lane->died_in_a_query())
          return core::Error{"it died while its shapes were loaded: " + lane->last_words(kLoad_s), std::string(engine),
                             "", core::Exit::kMissing};
        on_death(lane->at(), lane->fate(), words);
        lane->go_on_behind(lane->at());
        is_done = !lane->has_more();
      }
      if (is_done)
        std::erase_if(lanes, [&](const auto& one) { return one.get() == lane; });
      else if (core::Status s = lane->spawn(limits.memory_mib, live); !s)
        return s.error();
    }
  }
  return core::Done{};
}

}  // namespace broadside::bench
