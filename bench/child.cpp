#include "bench/child.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/plugin_engines.hpp"

namespace broadside::bench {
namespace {

std::vector<std::string> arguments(const CellRequest& r, const std::filesystem::path& cell_folder) {
  std::vector<std::string> args{"broadside",
                                "run",
                                r.source.spec,
                                "--engine",
                                engine_argument(*r.row),
                                "--frames",
                                std::to_string(r.frames),
                                "--every",
                                std::to_string(r.selection.every),
                                "--narrow-every",
                                std::to_string(r.narrow_every),
                                "--record",
                                r.level == core::RecordLevel::kFull     ? "full"
                                : r.level == core::RecordLevel::kDigest ? "digest"
                                                                        : "none",
                                "--out",
                                r.folder.string(),
                                "--driver",
                                r.driver_trace.string(),
                                "--in-process",
                                cell_folder.string()};
  for (const StepWindow& w : r.selection.windows) {
    args.emplace_back("--window");
    args.push_back(fmt::format("{}:{}", w.first, w.last));
  }
  if (r.resume) args.emplace_back("--resume");
  if (r.source.allow_stand_in) args.emplace_back("--stand-in");
  for (const auto& [key, value] : r.settings) {
    args.emplace_back("--set");
    args.push_back(key + "=" + value);
  }
  return args;
}

// Passes the child's stderr on and keeps its last line: an assert's message, or our own one clear line.
class StderrTail {
 public:
  void take(const char* data, std::size_t size) {
    std::fwrite(data, 1, size, stderr);
    for (std::size_t k = 0; k < size; ++k) {
      if (data[k] == '\n') {
        if (!line_.empty()) last_ = line_;
        line_.clear();
      } else {
        line_ += data[k];
      }
    }
  }
  [[nodiscard]] const std::string& last_line() const { return line_.empty() ? last_ : line_; }

 private:
  std::string line_;
  std::string last_;
};

struct Ending {
  int status = 0;
  bool timed_out = false;
  std::string last_line;
};

// Reads the pipe until the child closes it, then reaps the child.
Ending attend(pid_t child, int pipe_end, double time_limit_s) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Ending ending;
  StderrTail tail;
  bool told = false;
  std::array<char, 4096> buffer{};
  for (;;) {
    pollfd waiting{pipe_end, POLLIN, 0};
    const int ready = poll(&waiting, 1, 100);
    if (is_interrupted() && !told) {
      kill(child, SIGINT);
      told = true;
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > time_limit_s && !ending.timed_out) {
      ending.timed_out = true;
      kill(child, SIGKILL);
    }
    if (ready <= 0) continue;
    const ssize_t got = read(pipe_end, buffer.data(), buffer.size());
    if (got == 0) break;
    if (got > 0) tail.take(buffer.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) break;
  }
  while (waitpid(child, &ending.status, 0) < 0 && errno == EINTR) {
  }
  ending.last_line = tail.last_line();
  return ending;
}

core::Cell ended_badly(const CellRequest& request, core::CellState state, const std::string& reason) {
  core::Cell cell;
  cell.state = state;
  cell.reason = reason;
  auto settings = core::Settings::parse(request.row->id, request.row->settings, request.settings);
  core::Engine nameless;
  nameless.id = std::string(request.row->id);
  if (settings) nameless.settings = settings.value();
  cell.stamp = stamp_of(*request.scene, nameless);
  const std::string part = trace_file_name(cell.stamp) + ".part";
  std::error_code ignored;
  if (std::filesystem::exists(request.folder / part, ignored)) cell.trace_file = part;
  return cell;
}

}  // namespace

core::Result<core::Cell> record_cell_in_child(const CellRequest& request, double time_limit_s) {
  const std::filesystem::path cell_folder = request.folder / fmt::format(".cell-{}", getpid());
  std::error_code failed;
  std::filesystem::create_directories(cell_folder, failed);
  if (failed)
    return core::Error{"cannot write there: " + failed.message(), request.folder.string(), "choose another --out"};

  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0)
    return core::Error{"no pipe: " + std::string(std::strerror(errno)), "starting a child process", "",
                       core::Exit::kInternal};
  const std::vector<std::string> args = arguments(request, cell_folder);
  std::vector<char*> argv;
  for (const std::string& a : args) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    // Only async-signal-safe calls here: other threads of the parent may hold locks.
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv("/proc/self/exe", argv.data());
    _exit(127);
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return core::Error{"no child process: " + std::string(std::strerror(errno)), "fork", "", core::Exit::kInternal};
  }
  const Ending ending = attend(child, ends[0], time_limit_s);
  close(ends[0]);

  auto rows = core::read_rows(cell_folder);
  std::filesystem::remove_all(cell_folder, failed);
  if (ending.timed_out)
    return ended_badly(request, core::CellState::kTimedOut, fmt::format("no end after {:.0f} s", time_limit_s));
  if (WIFSIGNALED(ending.status)) {
    const int signal = WTERMSIG(ending.status);
    return ended_badly(request, core::CellState::kCrashed,
                       fmt::format("signal {} ({}){}{}", signal, strsignal(signal),
                                   ending.last_line.empty() ? "" : ": ", ending.last_line));
  }
  if (rows.ok() && rows.value().cells.size() == 1) return rows.value().cells[0];
  if (WIFEXITED(ending.status) && WEXITSTATUS(ending.status) == 2) return core::Error{ending.last_line};
  return ended_badly(request, core::CellState::kCrashed,
                     fmt::format("exit code {}: {}", WEXITSTATUS(ending.status), ending.last_line));
}

}  // namespace broadside::bench
