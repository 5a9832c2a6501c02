#include "bench/timing/turns.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <limits>

#include "bench/process/interrupt.hpp"

namespace broadside::bench {
namespace {

// The length of a turn: long compared with the cost of a handover (some 10 us, and caches that the other process used),
// and short compared with the tens of milliseconds in which half of the load on a neighboring core has changed
// (reports/README.md).
constexpr std::chrono::microseconds kTurn{1000};

constexpr std::uint64_t kToTheEnd = std::numeric_limits<std::uint64_t>::max();

bool send_number(int socket, std::uint64_t number) {
  return send(socket, &number, sizeof number, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof number);
}

// False when the other process is gone, or this process was told to stop. Eight bytes sent in one call arrive in one
// piece.
bool receive_number(int socket, std::uint64_t& number) {
  ssize_t got = 0;
  do {
    got = recv(socket, &number, sizeof number, MSG_WAITALL);
  } while (got < 0 && errno == EINTR && !is_interrupted());
  return got == static_cast<ssize_t>(sizeof number);
}

bool read_number(const std::string& text, int& number) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  number = static_cast<int>(value);
  return !text.empty() && *end == '\0' && value >= -1 && value < CPU_SETSIZE;
}

}  // namespace

Turns::~Turns() {
  if (socket_ >= 0) close(socket_);
}

core::Status Turns::join(const std::string& text) {
  const core::Error error{"is not a turn", "--turns " + text,
                          "compare --interleave writes first:FD:CORE or second:FD:CORE"};
  const std::size_t colon = text.find(':');
  const std::size_t next = colon == std::string::npos ? colon : text.find(':', colon + 1);
  if (next == std::string::npos) return error;
  const std::string role = text.substr(0, colon);
  int socket = -1;
  if ((role != "first" && role != "second") || !read_number(text.substr(colon + 1, next - colon - 1), socket) ||
      !read_number(text.substr(next + 1), core_))
    return error;
  int kind = 0;
  socklen_t size = sizeof kind;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &kind, &size) != 0 || kind != SOCK_STREAM) return error;
  fcntl(socket, F_SETFD, FD_CLOEXEC);  // processes that this one starts must not inherit it
  socket_ = socket;
  is_first_ = role == "first";
  return core::Done{};
}

// Moves this thread to the core, and then restores the set of cores that it may use, because threads that it starts
// later inherit that set.
void Turns::sit_down() const {
  if (core_ < 0 || sched_getcpu() == core_) return;
  cpu_set_t before;
  if (sched_getaffinity(0, sizeof before, &before) != 0) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(core_), &one);
  if (sched_setaffinity(0, sizeof one, &one) == 0) sched_setaffinity(0, sizeof before, &before);
}

// Waits until the turn comes back or the other process is gone; in the latter case this process goes on alone.
void Turns::hand_over() {
  std::uint64_t number = 0;
  if (!send_number(socket_, done_) || !receive_number(socket_, number)) {
    close(socket_);
    socket_ = -1;
    return;
  }
  until_ = number;
  sit_down();
  began_ = std::chrono::steady_clock::now();
}

void Turns::begin() {
  if (socket_ < 0) return;
  std::uint64_t ready = 0;
  if (!is_first_) return hand_over();
  if (receive_number(socket_, ready)) {
    sit_down();
    began_ = std::chrono::steady_clock::now();
    return;
  }
  close(socket_);
  socket_ = -1;
}

void Turns::frame_done() {
  if (socket_ < 0) return;
  ++done_;
  if (is_first_ ? std::chrono::steady_clock::now() - began_ >= kTurn : done_ >= until_) hand_over();
}

void Turns::end() {
  if (socket_ < 0) return;
  if (is_first_) {
    done_ = kToTheEnd;
    hand_over();
  }
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
}

}  // namespace broadside::bench
