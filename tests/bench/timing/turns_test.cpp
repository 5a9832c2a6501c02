// Two processes in turns: they never run at once and never get far from each other, and neither waits for a process
// that has ended.
#include "bench/timing/turns.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>

namespace broadside::bench {
namespace {

std::array<int, 2> connected() {
  std::array<int, 2> ends{};
  EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  return ends;
}

std::string turn(const char* role, int socket) {
  return std::string(role) + ":" + std::to_string(socket) + ":-1";
}

struct Shared {
  std::atomic<int> inside{0};
  std::atomic<bool> were_two_inside{false};
  std::array<std::atomic<std::int64_t>, 2> done{};
  std::atomic<std::int64_t> farthest{0};  // how many frames the first was ahead of the second, at most
  std::atomic<std::int64_t> nearest{0};
};

// The work of one of the two, in a thread of its own: `frames` frames of 0.1 ms.
void work(const std::string& role, std::int64_t frames, std::size_t self, Shared& shared) {
  Turns turns;
  EXPECT_TRUE(turns.join(role));
  turns.begin();
  for (std::int64_t k = 0; k < frames; ++k) {
    if (shared.inside.fetch_add(1) != 0) shared.were_two_inside = true;
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::microseconds(100)) {
    }
    ++shared.done[self];
    const std::int64_t ahead = shared.done[0] - shared.done[1];
    shared.farthest = std::max<std::int64_t>(shared.farthest, ahead);
    shared.nearest = std::min<std::int64_t>(shared.nearest, ahead);
    shared.inside.fetch_sub(1);
    turns.frame_done();
  }
  turns.end();
}

void work_both(std::int64_t first, std::int64_t second, Shared& shared) {
  const std::array<int, 2> ends = connected();
  std::thread other(work, turn("second", ends[1]), second, std::size_t{1}, std::ref(shared));
  work(turn("first", ends[0]), first, 0, shared);
  other.join();
}

TEST(Turns, OneWorksWhileTheOtherWaitsAndTheyStayTogether) {
  Shared shared;
  work_both(500, 500, shared);
  EXPECT_EQ(shared.done[0], 500);
  EXPECT_EQ(shared.done[1], 500);
  EXPECT_FALSE(shared.were_two_inside);
  // Frames of 0.1 ms in turns of a millisecond; a busy machine makes fewer of them.
  EXPECT_LE(shared.farthest, 12);
  EXPECT_GE(shared.nearest, 0) << "the second follows";
}

TEST(Turns, WhoeverHasMoreFramesGoesOnAlone) {
  Shared first_has_more;
  work_both(100, 30, first_has_more);
  EXPECT_EQ(first_has_more.done[0] + first_has_more.done[1], 130);
  Shared second_has_more;
  work_both(30, 100, second_has_more);
  EXPECT_EQ(second_has_more.done[0] + second_has_more.done[1], 130);
  EXPECT_FALSE(second_has_more.were_two_inside) << "the first waits until the second has done all";
}

TEST(Turns, NobodyWaitsForOneThatIsGone) {
  for (const char* role : {"first", "second"}) {
    Shared shared;
    const std::array<int, 2> ends = connected();
    close(ends[1]);
    work(turn(role, ends[0]), 20, 0, shared);
    EXPECT_EQ(shared.done[0], 20);
  }
}

TEST(Turns, AloneNothingWaits) {
  Turns turns;
  turns.begin();
  turns.frame_done();
  turns.end();
}

TEST(Turns, WhatIsNoTurnIsRefused) {
  for (const char* text :
       {"", "first", "first:", "first:0", "third:3:0", "first:x:0", "first:999:0", "first:1:x", "second:0:-2"}) {
    Turns turns;
    EXPECT_FALSE(turns.join(text)) << text;
  }
}

}  // namespace
}  // namespace broadside::bench
