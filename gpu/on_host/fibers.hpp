// Runs a kernel on the host. Every thread of the grid is a fiber, and all fibers are alive at once, as in a cooperative
// launch.
#pragma once

#include <cstdint>
#include <functional>

namespace broadside::gpu::on_host {

struct Index {
  unsigned x = 0;
};

struct Launch {
  Index grid_size;   // blocks
  Index block_size;  // threads; whole warps
  std::uint64_t seed = 0;
};
inline constexpr Launch kOneWarp{{1}, {32}, 0};

// The running fiber's place in the grid.
struct Place {
  Index thread;
  Index block;
};

// Runs `body` once per thread, with its block's `shared_bytes` of shared memory, until all have returned. A barrier
// that some thread never reaches ends the program with a line that says so. Not re-entrant.
void run(const Launch& launch, std::size_t shared_bytes, const std::function<void(unsigned char* shared)>& body);

// These are for code that runs in a fiber.
const Place& self();
const Launch& launch();
void yield();
void sync_grid();
// A barrier of the block. Returns true if any of its threads passed true.
bool sync_block(bool value);
// A barrier of the warp. Returns the values of its 32 lanes, which stay valid until the call after the next one.
const std::uint64_t* exchange(std::uint64_t value);
std::uint64_t now_ns();

}  // namespace broadside::gpu::on_host
