#include "bench/process/interrupt.hpp"

#include <csignal>

namespace broadside::bench {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  // A write past `ulimit -f` then fails with an error line instead of ending the process by a signal.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool is_interrupted() {
  return interrupted != 0;
}

}  // namespace broadside::bench
