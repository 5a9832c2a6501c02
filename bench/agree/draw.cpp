#include "bench/agree/draw.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "bench/process/interrupt.hpp"
#include "bench/process/process_limits.hpp"
#include "bench/process/shared_array.hpp"

namespace broadside::bench {
namespace {

// How many pairs a process has drawn; the parent reads it meanwhile.
struct Drawn {
  volatile std::uint64_t count = 0;
};

core::Error failed(const char* what) {
  return {std::string(what), "agree: drawing pairs", "", core::Exit::kInternal};
}

}  // namespace

core::Status draw_in_children(std::uint64_t count, std::uint32_t processes,
                              const std::function<void(std::uint64_t)>& draw_one,
                              const std::function<void(std::uint64_t)>& progress) {
  SharedArray<Drawn> drawn(std::max(1U, processes));
  std::vector<pid_t> children;
  const auto end_all = [&] {
    for (const pid_t child : children) kill(child, SIGKILL);
    for (const pid_t child : children) waitpid(child, nullptr, 0);
  };
  const std::uint64_t step = drawn.all().size();
  for (std::uint64_t first = 0; first < step; ++first) {
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) {
      end_all();
      return failed(std::generic_category().message(errno).c_str());
    }
    if (child == 0) {
      die_with(parent);
      // Each process takes every step-th pair, so that slow separations are spread over all processes.
      for (std::uint64_t k = first; k < count; k += step) {
        draw_one(k);
        drawn[first].count = drawn[first].count + 1;
      }
      _exit(0);
    }
    children.push_back(child);
  }
  bool is_good = true;
  while (!children.empty()) {
    usleep(20'000);
    std::uint64_t done = 0;
    for (const Drawn& d : drawn.all()) done += d.count;
    progress(done);
    if (is_interrupted()) {
      end_all();
      return core::Error{"interrupted", "agree", "", core::Exit::kMissing};
    }
    std::erase_if(children, [&](pid_t child) {
      int status = 0;
      const bool has_ended = waitpid(child, &status, WNOHANG) == child;
      if (has_ended) is_good = is_good && WIFEXITED(status) && WEXITSTATUS(status) == 0;
      return has_ended;
    });
  }
  if (!is_good) return failed("a process died, perhaps because memory ran out");
  return core::Done{};
}

core::Result<std::vector<TestPair>> draw_pairs(PairSource& source, std::uint64_t count, std::uint32_t processes,
                                               const std::function<void(std::uint64_t)>& progress) {
  SharedArray<TestPair> pairs(count);
  const auto draw_one = [&](std::uint64_t k) { pairs[k] = source.pair(k); };
  if (core::Status s = draw_in_children(count, processes, draw_one, progress); !s) return s.error();
  return std::vector<TestPair>(pairs.all().begin(), pairs.all().end());
}

}  // namespace broadside::bench
