// Two timed processes that take turns of some milliseconds on one core.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/result.hpp"

namespace broadside::bench {

// What disturbs a core comes and goes in milliseconds to seconds, and for each core on its own: on a virtual machine it
// is the neighbor that shares the physical core, which costs up to 1.8 times. Two processes that compute the same
// frames within some milliseconds on one core see the same of it, and the ratio of their frames does not.
//
// The first process ends its turn after the first frame past the length of a turn and says how many frames it has done;
// the second does as many and gives the turn back. So frame k of both is computed within two turns, and where one of
// them stops or dies the other goes on alone.
class Turns {
 public:
  Turns() = default;  // alone: nothing below waits
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;
  ~Turns();

  // "first:FD:CORE" or "second:FD:CORE": FD, which this object owns from now on, is one end of a connected pair of
  // stream sockets that the other process has the other end of; each turn begins on CORE, or where it likes with -1.
  core::Status join(const std::string& text);

  // Whether nothing below waits.
  [[nodiscard]] bool are_alone() const { return socket_ < 0; }

  // Waits until both processes have set up and this one has its turn. No other work may be in between: it would run
  // beside the other's clock.
  void begin();

  // A frame, or whatever else both do equally often, was done: hands over where that is due.
  void frame_done();

  // All frames were done. The first one waits for the second, which is still being timed.
  void end();

 private:
  void sit_down() const;
  void hand_over();

  int socket_ = -1;
  int core_ = -1;
  bool is_first_ = false;
  std::uint64_t done_ = 0;
  std::uint64_t until_ = 0;  // of the second: how many frames the first has done
  std::chrono::steady_clock::time_point began_;
};

}  // namespace broadside::bench
