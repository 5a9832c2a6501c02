// Measures what the GPU's broad phase gains by keeping data from frame to frame, and how it hands on pairs: boxes that
// move little, a static world, pairs in chunks. Each mode runs beside the plain one on the same boxes, and both must
// find pairs of equal digests. Prints one JSON line for each row; times are medians over frames, ms; the exit code is 1
// where digests differ.
//   broadside_gpu_frames [MOVING_N [STATIC_N [FRAMES]]]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/benchmarks/gpu_pair_digest.hpp"
#include "core/pair.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "gpu/broad/kept_finder.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::bench {
namespace {

using core::Box;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

bool complain(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return false;
}

double ms_since(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

// Times and digest of the frames of a stream whose boxes lie on the device: update and find, by the host's clock.
struct Frames {
  std::vector<double> ms;
  std::uint64_t digest = 0;
};

template <typename Finder>
bool run_frames(Finder& finder, const std::string& spec, std::uint32_t frames, Frames& out) {
  auto made = datasets::make_box_stream("boxes:" + spec);
  if (!made) return complain(made.error());
  datasets::BoxStream& stream = made.value();
  const std::vector<std::uint8_t> is_static(stream.boxes.size());
  gpu::DeviceBuffer<Box> there;
  for (std::uint32_t k = 0; k < std::min(frames, stream.frames); ++k) {
    if (k > 0)
      if (core::Status s = stream.advance(stream.boxes); !s) return complain(s.error());
    if (core::Status s = there.upload(stream.boxes, "boxes"); !s) return complain(s.error());
    if (core::Status s = gpu::wait_for_device("copying boxes"); !s) return complain(s.error());
    const core::DeviceBoxes boxes{reinterpret_cast<const float*>(there.data()), stream.boxes.size()};
    const auto start = Clock::now();
    if (core::Status s = k == 0 ? finder.load_on_device(boxes, is_static) : finder.update_on_device(boxes); !s)
      return complain(s.error());
    if (core::Status s = finder.find(); !s) return complain(s.error());
    // The first frames are left out: arrays still grow, and the GPU's clock rate still rises.
    if (k > 4) out.ms.push_back(ms_since(start));
    auto pairs = finder.pairs_on_device();
    if (!pairs) return complain(pairs.error());
    auto digest = digest_of(pairs.value());
    if (!digest) return complain(digest.error());
    out.digest += core::splitmix64(digest.value() + k);
  }
  return true;
}

bool race_kept(const std::string& spec, std::uint32_t frames) {
  gpu::PairFinder plain({});
  gpu::KeptFinder kept({});
  Frames of_plain, of_kept;
  if (!run_frames(plain, spec, frames, of_plain) || !run_frames(kept, spec, frames, of_kept)) return false;
  const auto counters = kept.counters();
  std::printf(
      "{\"what\": \"kept\", \"boxes\": \"%s\", \"frames\": %u, \"digest\": \"0x%016llx\", \"is_equal\": %s, "
      "\"scratch_ms\": %.4f, \"kept_ms\": %.4f, \"candidates\": %llu, \"searched\": %llu, \"not_searched\": %llu}\n",
      spec.c_str(), frames, static_cast<unsigned long long>(of_kept.digest),
      of_kept.digest == of_plain.digest ? "true" : "false", median(of_plain.ms), median(of_kept.ms),
      static_cast<unsigned long long>(counters[0].count), static_cast<unsigned long long>(counters[1].count),
      static_cast<unsigned long long>(counters[2].count));
  std::fflush(stdout);
  return of_kept.digest == of_plain.digest;
}

// The boxes of the triangles of a hilly ground, two triangles for each square of half a meter; the moving boxes start
// in the middle of it.
std::vector<Box> world_of(std::uint32_t static_boxes, std::uint32_t moving_boxes) {
  constexpr float kSide = 0.5F;
  const auto squares = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(static_boxes) / 2.0));
  const auto height = [](std::uint32_t x, std::uint32_t y) {
    return 2.0F * std::sin(0.05F * static_cast<float>(x)) * std::cos(0.04F * static_cast<float>(y));
  };
  std::vector<Box> boxes;
  boxes.reserve(2 * std::size_t{squares} * squares + moving_boxes);
  for (std::uint32_t x = 0; x < squares; ++x) {
    for (std::uint32_t y = 0; y < squares; ++y) {
      const float corner[4] = {height(x, y), height(x + 1, y), height(x, y + 1), height(x + 1, y + 1)};
      for (int triangle = 0; triangle < 2; ++triangle) {
        const auto [low, high] = std::minmax({corner[triangle == 0 ? 0 : 3], corner[1], corner[2]});
        const core::Vec3 at{kSide * static_cast<float>(x), kSide * static_cast<float>(y), 0.0F};
        boxes.push_back({{at.x, at.y, low}, {at.x + kSide, at.y + kSide, high}});
      }
    }
  }
  const float middle = 0.25F * kSide * static_cast<float>(squares);
  for (const Box& box : datasets::uniform_boxes(moving_boxes, 1))
    boxes.push_back(core::translated(box, {middle, middle, 0.0F}));
  return boxes;
}

bool find_often(gpu::PairFinder& finder, std::uint32_t frames, double& ms, std::uint64_t& digest) {
  std::vector<double> all;
  for (std::uint32_t k = 0; k < frames + 20; ++k) {
    if (core::Status s = finder.find(); !s) return complain(s.error());
    if (k >= 20) all.push_back(finder.find_time().whole_s * 1e3);
  }
  ms = median(all);
  auto pairs = finder.pairs_on_device();
  if (!pairs) return complain(pairs.error());
  auto sum = digest_of(pairs.value());
  if (!sum) return complain(sum.error());
  digest = sum.value();
  return true;
}

bool race_static(std::uint32_t static_boxes, std::uint32_t moving_boxes, std::uint32_t frames) {
  const std::vector<Box> boxes = world_of(static_boxes, moving_boxes);
  std::vector<std::uint8_t> is_static(boxes.size(), 1);
  std::fill(is_static.end() - moving_boxes, is_static.end(), std::uint8_t{0});
  double apart_ms = 0.0, together_ms = 0.0, alone_ms = 0.0;
  std::uint64_t of_apart = 0, of_together = 0, of_alone = 0;
  {
    gpu::PairFinder apart({});
    if (core::Status s = apart.load(boxes, is_static); !s) return complain(s.error());
    if (!find_often(apart, frames, apart_ms, of_apart)) return false;
  }
  {
    gpu::PairFinderOptions options;
    options.least_for_apart = 0xFFFFFFFFU;
    gpu::PairFinder together(options);
    if (core::Status s = together.load(boxes, is_static); !s) return complain(s.error());
    if (!find_often(together, frames, together_ms, of_together)) return false;
  }
  gpu::PairFinder alone({});
  const std::vector<Box> moving(boxes.end() - moving_boxes, boxes.end());
  if (core::Status s = alone.load(moving, std::vector<std::uint8_t>(moving.size())); !s) return complain(s.error());
  if (!find_often(alone, frames, alone_ms, of_alone)) return false;
  std::printf(
      "{\"what\": \"static apart\", \"static\": %zu, \"moving\": %u, \"digest\": \"0x%016llx\", \"is_equal\": %s, "
      "\"apart_ms\": %.4f, \"together_ms\": %.4f, \"moving_alone_ms\": %.4f}\n",
      boxes.size() - moving_boxes, moving_boxes, static_cast<unsigned long long>(of_apart),
      of_apart == of_together ? "true" : "false", apart_ms, together_ms, alone_ms);
  std::fflush(stdout);
  return of_apart == of_together;
}

bool race_chunks(std::uint32_t n, std::uint64_t at_once) {
  const std::vector<Box> boxes = datasets::uniform_boxes(n, 1);
  const std::vector<std::uint8_t> is_static(n);
  double all_ms = 0.0;
  std::uint64_t of_all = 0, of_chunks = 0, chunks = 0;
  {
    gpu::PairFinder all({});
    if (core::Status s = all.load(boxes, is_static); !s) return complain(s.error());
    if (!find_often(all, 10, all_ms, of_all)) return false;
  }
  gpu::PairFinderOptions options;
  options.pairs_at_once = at_once;
  gpu::PairFinder chunked(options);
  if (core::Status s = chunked.load(boxes, is_static); !s) return complain(s.error());
  std::vector<double> ms;
  for (int k = 0; k < 10; ++k) {
    const auto start = Clock::now();
    if (core::Status s = chunked.find(); !s) return complain(s.error());
    ms.push_back(ms_since(start));
  }
  const core::Status status = chunked.hand_on([&](const core::DevicePairs& pairs) -> core::Status {
    auto sum = digest_of(pairs);
    if (!sum) return sum.error();
    of_chunks += sum.value();
    ++chunks;
    return core::Done{};
  });
  if (!status) return complain(status.error());
  std::printf(
      "{\"what\": \"chunks\", \"n\": %u, \"pairs_at_once\": %llu, \"chunks\": %llu, \"digest\": \"0x%016llx\", "
      "\"is_equal\": %s, \"chunks_ms\": %.4f, \"all_ms\": %.4f}\n",
      n, static_cast<unsigned long long>(at_once), static_cast<unsigned long long>(chunks),
      static_cast<unsigned long long>(of_chunks), of_chunks == of_all ? "true" : "false", median(ms), all_ms);
  std::fflush(stdout);
  return of_chunks == of_all;
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  using namespace broadside::bench;
  if (const std::string why = broadside::gpu::gpu_absent(); !why.empty())
    return std::fprintf(stderr, "%s\n", why.c_str()), 3;
  const auto number = [&](int k, long otherwise) {
    return static_cast<std::uint32_t>(count > k ? std::max(1L, std::atol(given[k])) : otherwise);
  };
  const std::uint32_t moving = number(1, 1'000'000);
  const std::uint32_t standing = number(2, 10'000'000);
  const std::uint32_t frames = number(3, 40);
  bool is_good = race_kept("moving:" + std::to_string(moving / 10), frames);
  is_good = race_kept("moving:" + std::to_string(moving), frames) && is_good;
  is_good = race_kept("sheet:150000", frames) && is_good;
  is_good = race_static(standing, moving, frames) && is_good;
  is_good = race_chunks(10 * moving, 4 * moving) && is_good;
  return is_good ? 0 : 1;
}
