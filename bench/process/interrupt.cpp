#include "bench/process/interrupt.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <csignal>
#include <ctime>

#include "core/result.hpp"

namespace broadside::bench {
namespace {

// Time from the signal to the end of the program. Work in one long call never reads the flag: it is ended with one line
// and exit code 3. Work that has read the flag gets time to write what it recorded. No file is left half-written under
// its final name, because files are renamed when they are complete.
constexpr suseconds_t kUnheard_us = 600'000;
constexpr time_t kHeard_s = 10;
// On Ctrl-C the terminal signals a child too, and its parent passes the signal on: within this time they count as one.
constexpr double kSameSignal_s = 0.4;

volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t heard = 0;
timespec first_signal{};

double seconds_since_first_signal() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - first_signal.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - first_signal.tv_nsec);
}

// Async-signal-safe on Linux, where setitimer is a plain system call.
void end_after(time_t seconds, suseconds_t microseconds) {
  const itimerval once{{0, 0}, {seconds, microseconds}};
  setitimer(ITIMER_REAL, &once, nullptr);
}

void on_signal(int signal) {
  if (interrupted != 0) {  // a second signal ends the program at once
    if (seconds_since_first_signal() < kSameSignal_s) return;
    std::signal(signal, SIG_DFL);
    raise(signal);
    return;
  }
  clock_gettime(CLOCK_MONOTONIC, &first_signal);
  interrupted = 1;
  end_after(0, kUnheard_us);
}

void on_time_out(int) {
  constexpr char kLine[] = "broadside: interrupted\n";
  // If the line cannot be written, there is nothing else to do.
  if (write(STDERR_FILENO, kLine, sizeof kLine - 1) < 0) _exit(static_cast<int>(core::Exit::kMissing));
  _exit(static_cast<int>(core::Exit::kMissing));
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGALRM, on_time_out);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  // A write past `ulimit -f` then fails with an error line instead of ending the process by a signal.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_interrupted() {
  if (interrupted != 0 && heard == 0) {
    heard = 1;
    end_after(kHeard_s, 0);
  }
  return interrupted != 0;
}

}  // namespace broadside::bench
