#include "gpu/on_host/fibers.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "gpu/on_host/fiber_context.hpp"

namespace broadside::gpu::on_host {
namespace {

constexpr std::size_t kStackBytes = std::size_t{128} << 10U;
// The most rounds over all fibers in which no barrier opens and no fiber returns: far more than any spin loop needs.
constexpr std::uint64_t kMostIdleRounds = 1'000'000;

// A barrier for a fixed number of fibers, used again and again. It uses two sets of slots in turn, which is enough: no
// fiber writes for the barrier after next before all fibers have left this one.
struct Barrier {
  unsigned members = 0;
  unsigned arrived = 0;
  std::uint64_t passed = 0;  // how often all fibers have arrived
  bool any[2] = {};
  std::uint64_t slots[2][32] = {};
};

struct Fiber {
  FiberContext context;
  Place place;
  const Barrier* waits_at = nullptr;
  std::uint64_t passed = 0;  // Barrier::passed when the fiber arrived
  bool is_done = false;
};

struct Grid {
  Launch launch;
  const std::function<void(unsigned char*)>* body = nullptr;
  std::vector<Fiber> fibers;
  std::vector<Barrier> warps;
  std::vector<Barrier> blocks;
  Barrier all;
  std::vector<std::vector<unsigned char>> shared;
  FiberContext scheduler;
  Fiber* running = nullptr;
  std::uint64_t events = 0;
};

Grid* grid = nullptr;

// Stacks are kept for the next launch: most launches are so short that making new stacks would take longer.
std::vector<std::unique_ptr<unsigned char[]>> stacks;

void enter() {
  Fiber& own = *grid->running;
  (*grid->body)(grid->shared[own.place.block.x].data());
  own.is_done = true;
  ++grid->events;
  yield();
}

void wait_at(Barrier& barrier) {
  const std::uint64_t passed = barrier.passed;
  if (++barrier.arrived == barrier.members) {
    barrier.arrived = 0;
    ++barrier.passed;
    barrier.any[barrier.passed % 2] = false;  // for the next barrier
    ++grid->events;
    return;
  }
  Fiber& own = *grid->running;
  own.waits_at = &barrier;
  own.passed = passed;
  yield();
  own.waits_at = nullptr;
}

// Whether the fiber waits at a barrier that has not opened. It is not switched to, since it would only switch back.
bool is_held(const Fiber& fiber) {
  return fiber.waits_at != nullptr && fiber.waits_at->passed == fiber.passed;
}

std::uint64_t scrambled(std::uint64_t& state) {
  state ^= state << 13;
  state ^= state >> 7;
  return state ^= state << 17;
}

void schedule() {
  std::vector<std::uint32_t> order(grid->fibers.size());
  std::iota(order.begin(), order.end(), 0U);
  std::uint64_t state = grid->launch.seed * 2 + 1;
  std::uint64_t idle = 0;
  for (std::size_t left = order.size(); left > 0;) {
    if (grid->launch.seed != 0)
      for (std::size_t k = left - 1; k > 0; --k) std::swap(order[k], order[scrambled(state) % (k + 1)]);
    const std::uint64_t before = grid->events;
    for (std::size_t k = 0; k < left; ++k) {
      if (is_held(grid->fibers[order[k]])) continue;
      grid->running = &grid->fibers[order[k]];
      FiberContext::switch_over(grid->scheduler, grid->running->context);
    }
    idle = grid->events == before ? idle + 1 : 0;
    if (idle > kMostIdleRounds) {
      std::fprintf(stderr, "on_host: %zu threads of the kernel wait for threads that never come\n", left);
      std::abort();
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < left; ++k)
      if (!grid->fibers[order[k]].is_done) order[kept++] = order[k];
    left = kept;
  }
}

}  // namespace

void run(const Launch& launch, std::size_t shared_bytes, const std::function<void(unsigned char*)>& body) {
  Grid own;
  own.launch = launch;
  own.body = &body;
  const unsigned threads = launch.grid_size.x * launch.block_size.x;
  own.fibers.resize(threads);
  own.warps.resize(threads / 32);
  own.blocks.resize(launch.grid_size.x);
  // Filled with a pattern, so that a kernel that reads shared memory before it is written does not find zeros by
  // chance.
  own.shared.assign(launch.grid_size.x, std::vector<unsigned char>(shared_bytes + 1, 0xA5));
  for (Barrier& warp : own.warps) warp.members = 32;
  for (Barrier& block : own.blocks) block.members = launch.block_size.x;
  own.all.members = threads;
  grid = &own;
  while (stacks.size() < threads) stacks.push_back(std::make_unique_for_overwrite<unsigned char[]>(kStackBytes));
  for (unsigned k = 0; k < threads; ++k) {
    Fiber& fiber = own.fibers[k];
    fiber.place = {{k % launch.block_size.x}, {k / launch.block_size.x}};
    fiber.context.begin(stacks[k].get(), kStackBytes, enter);
  }
  schedule();
  grid = nullptr;
}

const Place& self() {
  return grid->running->place;
}

const Launch& launch() {
  return grid->launch;
}

void yield() {
  Fiber& own = *grid->running;
  FiberContext::switch_over(own.context, grid->scheduler);
}

void sync_grid() {
  wait_at(grid->all);
}

bool sync_block(bool value) {
  Barrier& block = grid->blocks[self().block.x];
  const std::size_t set = block.passed % 2;
  block.any[set] = block.any[set] || value;
  wait_at(block);
  return block.any[set];
}

const std::uint64_t* exchange(std::uint64_t value) {
  const Place& own = self();
  Barrier& warp = grid->warps[(own.block.x * grid->launch.block_size.x + own.thread.x) / 32];
  std::uint64_t* slots = warp.slots[warp.passed % 2];
  slots[own.thread.x % 32] = value;
  wait_at(warp);
  return slots;
}

std::uint64_t now_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

}  // namespace broadside::gpu::on_host
