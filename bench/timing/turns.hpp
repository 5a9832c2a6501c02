// Two timed processes that take turns of some milliseconds on one core.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "core/result.hpp"

namespace broadside::bench {

// Disturbances of a core come and go within milliseconds to seconds, separately for each core. On a virtual machine
// they come from the neighbor that shares the physical core, and make work take up to 1.8 times as long. Two processes
// that compute the same frames on one core within some milliseconds are disturbed alike, so the ratio of their times is
// not disturbed.
//
// The first process ends its turn after the first frame that ends later than the length of a turn, and says how many
// frames it has done; the second does as many and gives the turn back. So frame k of both is computed within two turns.
// When one process stops or dies, the other goes on alone.
class Turns {
 public:
  Turns() = default;  // alone: the functions below do not wait
  Turns(const Turns&) = delete;
  Turns& operator=(const Turns&) = delete;
  ~Turns();

  // "first:FD:CORE" or "second:FD:CORE". This object owns FD from now on, one end of a connected pair of stream
  // sockets; the other process has the other end. Each turn begins on CORE, or on any core with -1.
  core::Status join(const std::string& text);

  // True when the functions below do not wait.
  [[nodiscard]] bool are_alone() const { return socket_ < 0; }

  // Waits until both processes are ready and it is this one's turn. Call it directly before the first frame: other work
  // here would run while the other process is being timed.
  void begin();

  // Call it after each frame (or any other unit that both do equally often): hands over when the turn is over.
  void frame_done();

  // Call after the last frame. The first process waits for the second, which is still being timed.
  void end();

 private:
  void sit_down() const;
  void hand_over();

  int socket_ = -1;
  int core_ = -1;
  bool is_first_ = false;
  std::uint64_t done_ = 0;
  std::uint64_t until_ = 0;  // in the second process: how many frames the first has done
  std::chrono::steady_clock::time_point began_;
};

}  // namespace broadside::bench
