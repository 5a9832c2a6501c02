#include "bench/process/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/plugin_engines.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/process/progress.hpp"

namespace broadside::bench {
namespace {

// Arguments that every command about one cell takes: scene, engine, settings, frames.
std::vector<std::string> cell_arguments(const char* command, const CellRequest& r) {
  std::vector<std::string> args{command,          r.source.spec,
                                "--engine",       engine_argument(*r.row),
                                "--frames",       std::to_string(r.frames),
                                "--narrow-every", std::to_string(r.narrow_every)};
  if (r.source.allow_stand_in) args.emplace_back("--stand-in");
  for (const auto& [key, value] : r.settings) {
    args.emplace_back("--set");
    args.push_back(key + "=" + value);
  }
  return args;
}

void append(std::vector<std::string>& args, std::initializer_list<std::string> more) {
  args.insert(args.end(), more);
}

std::vector<std::string> run_arguments(const CellRequest& r, const std::filesystem::path& cell_folder) {
  std::vector<std::string> args = cell_arguments("run", r);
  append(args, {"--every", std::to_string(r.selection.every), "--record",
                r.level == core::RecordLevel::kFull     ? "full"
                : r.level == core::RecordLevel::kDigest ? "digest"
                                                        : "none",
                "--out", r.folder.string(), "--driver", r.driver_trace.string(), "--in-process", cell_folder.string()});
  for (const StepWindow& w : r.selection.windows) append(args, {"--window", fmt::format("{}:{}", w.first, w.last)});
  if (r.resume) args.emplace_back("--resume");
  return args;
}

// Keeps the last line of the child's stderr (an assert's message or our own error line) and may pass all of it on.
class StderrTail {
 public:
  explicit StderrTail(bool passes_on) : passes_on_(passes_on) {}
  void take(const char* data, std::size_t size) {
    if (passes_on_) std::fwrite(data, 1, size, stderr);
    for (std::size_t k = 0; k < size; ++k) {
      if (data[k] == '\n') {
        if (!line_.empty()) last_ = line_;
        line_.clear();
      } else if (data[k] == '\r') {
        line_.clear();  // a progress line that is written over
      } else {
        line_ += data[k];
      }
    }
  }
  void pass_no_more_on() { passes_on_ = false; }
  [[nodiscard]] std::string last_line() const {
    // The terminal code that clears the line is cut off.
    const std::string& line = line_.empty() ? last_ : line_;
    constexpr std::string_view kClear = "\033[K";
    return line.starts_with(kClear) ? line.substr(kClear.size()) : line;
  }

 private:
  bool passes_on_;
  std::string line_;
  std::string last_;
};

struct Pipe {
  int from = -1;
  int to = -1;

  bool open() {
    // Close-on-exec: a child that another thread starts must not keep this pipe open. dup2 gives this child its own
    // streams without that flag.
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    from = ends[0];
    to = ends[1];
    return true;
  }
  void close_both() {
    for (int* end : {&from, &to})
      if (*end >= 0) close(std::exchange(*end, -1));
  }
};

// Reads a pipe once; false at its end.
template <typename Take>
bool drain(int from, Take&& take) {
  std::array<char, 4096> buffer;
  const ssize_t got = read(from, buffer.data(), buffer.size());
  if (got > 0) take(buffer.data(), static_cast<std::size_t>(got));
  return got > 0 || (got < 0 && errno == EINTR);
}

// How long an interrupted child may go on. By then it has ended itself, unless it blocks signals.
constexpr double kAfterInterrupt_s = 0.8;

// Reads both pipes until the child closes them, then reaps it; returns its status.
int attend(pid_t child, int out, int err, StderrTail tail, double time_limit_s, ChildEnding& ending) {
  using SteadyClock = std::chrono::steady_clock;
  const auto start = SteadyClock::now();
  const auto elapsed_s = [](SteadyClock::time_point since) {
    return std::chrono::duration<double>(SteadyClock::now() - since).count();
  };
  std::optional<SteadyClock::time_point> told;
  bool is_killed = false;
  std::array<pollfd, 2> waiting{pollfd{err, POLLIN, 0}, pollfd{out, POLLIN, 0}};
  while (waiting[0].fd >= 0 || waiting[1].fd >= 0) {
    const int ready = poll(waiting.data(), waiting.size(), 100);
    if (is_interrupted() && !told) {
      kill(child, SIGINT);
      told = SteadyClock::now();
      tail.pass_no_more_on();
    }
    if (!told && elapsed_s(start) > time_limit_s) ending.timed_out = true;
    if (!is_killed && (ending.timed_out || (told && elapsed_s(*told) > kAfterInterrupt_s))) {
      kill(child, SIGKILL);
      is_killed = true;
    }
    if (ready <= 0) continue;
    if (waiting[0].revents != 0 && !drain(err, [&](const char* data, std::size_t size) { tail.take(data, size); }))
      waiting[0].fd = -1;
    if (waiting[1].revents != 0 &&
        !drain(out, [&](const char* data, std::size_t size) { ending.output.append(data, size); }))
      waiting[1].fd = -1;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ending.last_line = tail.last_line();
  return status;
}

void name_ending(ChildEnding& ending, int status, double time_limit_s) {
  const std::string after = ending.last_line.empty() ? "" : ": " + ending.last_line;
  if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  ending.is_good = !ending.timed_out && ending.exit_code == 0;
  // After an interrupt, a crash of the engine cannot be distinguished from the end that was asked for.
  ending.is_interrupted = !ending.is_good && is_interrupted();
  if (ending.is_interrupted) {
    ending.words = "interrupted";
  } else if (ending.timed_out) {
    ending.words = fmt::format("no end after {:g} s", time_limit_s);
  } else if (WIFSIGNALED(status)) {
    const char* const name = strsignal(WTERMSIG(status));  // NOLINT(concurrency-mt-unsafe)
    ending.words = fmt::format("signal {} ({}){}", WTERMSIG(status), name, after);
  } else if (ending.exit_code != 0) {
    ending.words = fmt::format("exit code {}{}", ending.exit_code, after);
  }
}

core::Stamp stamp_of_request(const CellRequest& request) {
  core::Engine nameless;
  nameless.id = std::string(request.row->id);
  if (auto settings = core::Settings::parse(request.row->id, request.row->settings, request.settings))
    nameless.settings = std::move(settings).value();
  return stamp_of(*request.scene, nameless);
}

core::Cell ended_badly(const CellRequest& request, const ChildEnding& ending, const std::vector<std::string>& args) {
  core::Cell cell;
  cell.state = ending.is_interrupted ? core::CellState::kInterrupted
               : ending.timed_out    ? core::CellState::kTimedOut
                                     : core::CellState::kCrashed;
  cell.reason = ending.words;
  cell.stamp = stamp_of_request(request);
  // The input of an engine that does not simulate is the driver's trace beside it. With the arguments it repeats the
  // failure, in a process that may crash.
  cell.notes["repeat"] = command_line(args);
  cell.notes["verdict on its process"] = std::string(class_of(ending));
  const std::string part = trace_file_name(cell.stamp) + ".part";
  std::error_code ignored;
  if (std::filesystem::exists(request.folder / part, ignored)) cell.trace_file = part;
  return cell;
}

// The reason of a cell whose engine refused the scene before its first step, in the child's own words: the child prints
// "broadside: SCENE: unsupported: WHAT; ADVICE", or that the engine's bodies only translate, and ends with 3. Nothing
// has crashed then. Empty for other ends.
std::string unsupported_words(const ChildEnding& ending) {
  if (ending.exit_code != static_cast<int>(core::Exit::kMissing) || ending.is_interrupted) return {};
  constexpr std::string_view kName = "broadside: ";
  constexpr std::string_view kWord = "unsupported: ";
  const std::size_t at = ending.last_line.find(kWord);
  if (at != std::string::npos) return ending.last_line.substr(at + kWord.size());
  return ending.last_line.starts_with(kName) ? ending.last_line.substr(kName.size()) : ending.last_line;
}

core::Cell unsupported_cell(const CellRequest& request, std::string words) {
  core::Cell cell;
  cell.state = core::CellState::kUnsupported;
  cell.reason = std::move(words);
  cell.stamp = stamp_of_request(request);
  return cell;
}

// A folder within the run's folder for a child's files; it is removed with this object.
class CellFolder {
 public:
  explicit CellFolder(const std::filesystem::path& folder) : path_(folder / fmt::format(".cell-{}", getpid())) {
    std::filesystem::create_directories(path_, failed_);
  }
  CellFolder(const CellFolder&) = delete;
  CellFolder& operator=(const CellFolder&) = delete;
  ~CellFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] core::Status status() const {
    if (!failed_) return core::Done{};
    return core::Error{"cannot write there: " + failed_.message(), path_.parent_path().string(),
                       "choose another --out"};
  }

 private:
  std::filesystem::path path_;
  std::error_code failed_;
};

core::Error no_process(const char* what) {
  return {std::string(what) + ": " + std::generic_category().message(errno), "starting a child process", "",
          core::Exit::kInternal};
}

}  // namespace

std::string command_line(const std::vector<std::string>& arguments) {
  std::string line = "broadside";
  for (const std::string& a : arguments) {
    const bool is_plain = !a.empty() && a.find_first_of(" []'\"$*?;&|<>()") == std::string::npos;
    line += is_plain ? " " + a : " '" + a + "'";
  }
  return line;
}

void append_memory_limit(std::vector<std::string>& arguments, const ChildLimits& limits) {
  if (limits.memory_mib > 0) append(arguments, {"--memory-limit", std::to_string(limits.memory_mib)});
}

std::string_view class_of(const ChildEnding& ending) {
  if (ending.is_good) return {};
  if (ending.is_interrupted) return "interrupted";
  if (ending.timed_out) return "time-out";
  if (ending.signal != 0) return ending.signal == SIGABRT ? "abort" : "crash";
  // The text of vendor_call for std::bad_alloc, or the runtime's text for one that was not caught.
  const bool has_no_memory = ending.last_line.find("out of memory") != std::string::npos ||
                             ending.last_line.find("bad_alloc") != std::string::npos;
  return has_no_memory ? "out of memory" : "exception";
}

core::Result<ChildEnding> run_self(const std::vector<std::string>& arguments, const ChildLimits& limits, Keeps keeps) {
  Pipe err;
  Pipe out;
  if (!err.open() || (keeps != Keeps::kNothing && !out.open())) {
    err.close_both();
    return no_process("no pipe");
  }
  const bool passes_errors_on = keeps != Keeps::kOutputAndErrors;
  // The child's progress line is shown on this terminal, so the child counts as live.
  if (is_live() && passes_errors_on) setenv(kLiveVariable, "1", 1);  // NOLINT(concurrency-mt-unsafe)
  std::string name = "broadside";
  std::vector<std::string> owned = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& a : owned) argv.push_back(a.data());
  argv.push_back(nullptr);

  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    // Between fork and exec only async-signal-safe calls are allowed, because other threads of the parent may hold
    // locks. die_with ends the child when the parent dies, even if it died before this line: otherwise the child would
    // go on writing where a later try begins.
    die_with(parent);
    dup2(err.to, STDERR_FILENO);
    if (out.to >= 0) dup2(out.to, STDOUT_FILENO);
    for (const int end : {err.from, err.to, out.from, out.to})
      if (end >= 0) close(end);
    leave_no_core_file();
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  close(std::exchange(err.to, -1));
  if (out.to >= 0) close(std::exchange(out.to, -1));
  ChildEnding ending;
  if (child > 0) {
    const int status = attend(child, out.from, err.from, StderrTail(passes_errors_on), limits.seconds, ending);
    name_ending(ending, status, limits.seconds);
  }
  err.close_both();
  out.close_both();
  if (child < 0) return no_process("no child process");
  return ending;
}

core::Result<core::Cell> record_cell_in_child(const CellRequest& request, const ChildLimits& limits) {
  const CellFolder folder(request.folder);
  if (core::Status s = folder.status(); !s) return s.error();
  std::vector<std::string> args = run_arguments(request, folder.path());
  append_memory_limit(args, limits);
  auto ended = run_self(args, limits, Keeps::kNothing);
  if (!ended) return ended.error();
  ChildEnding& ending = ended.value();
  auto rows = core::read_rows(folder.path());
  const bool left_a_row = ending.exit_code >= 0 && rows.ok() && rows.value().cells.size() == 1;
  if (left_a_row) {
    core::Cell cell = std::move(rows.value().cells[0]);
    if (cell.state == core::CellState::kFailed) {
      ending.last_line = cell.reason;
      cell.notes["repeat"] = command_line(args);
      cell.notes["verdict on its process"] = std::string(class_of(ending));
    }
    return cell;
  }
  if (ending.exit_code == static_cast<int>(core::Exit::kBadInput)) return core::Error{ending.last_line};
  if (std::string words = unsupported_words(ending); !words.empty()) return unsupported_cell(request, std::move(words));
  return ended_badly(request, ending, args);
}

core::Result<core::Sample> time_cell_in_child(const CellRequest& request, const ChildLimits& limits) {
  const CellFolder folder(request.folder);
  if (core::Status s = folder.status(); !s) return s.error();
  std::vector<std::string> args = cell_arguments("time", request);
  append(args, {"--repetitions", "1", "--out", (request.folder / "samples.json").string(), "--in-process",
                folder.path().string()});
  append_memory_limit(args, limits);
  auto ended = run_self(args, limits, Keeps::kOutput);
  if (!ended) return ended.error();
  const ChildEnding& ending = ended.value();
  auto rows = core::read_rows(folder.path());
  if (ending.is_good && rows.ok() && rows.value().samples.size() == 1) return rows.value().samples[0];
  const std::string why = ending.exit_code > 0 && !ending.last_line.empty() ? ending.last_line : ending.words;
  const std::string verdict = why.empty() ? "it wrote no sample" : fmt::format("{}: {}", class_of(ending), why);
  return core::Error{verdict, std::string(request.row->id), "repeat: " + command_line(args), core::Exit::kMissing};
}

}  // namespace broadside::bench
