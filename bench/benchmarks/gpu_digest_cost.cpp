// Measures what recording digests adds to a frame of octree-gpu: blocks of frames with and without it alternate within
// one simulation, so that both kinds see the same bodies. A recorded frame goes to a trace as `broadside run --record
// digest` sends it. Prints one JSON line for each scene.
//   broadside_gpu_digest_cost FOLDER SCENE[/off] WARM_UP_FRAMES BLOCKS...    /off: without the vertex stage
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/record/frame_taker.hpp"
#include "core/engine/engine.hpp"
#include "core/trace/trace_stream.hpp"
#include "datasets/scenes.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/frame/pipeline.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kBlockFrames = 20;

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double at_share(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

class Race {
 public:
  Race(const core::Scene& scene, const gpu::PipelineOptions& options) : scene_(scene), pipeline_(options) {}

  core::Status run(const std::filesystem::path& folder, int warm_up, int blocks) {
    if (core::Status s = pipeline_.load(scene_); !s) return s;
    core::TraceHeader header;
    header.scene = scene_;
    header.stamp.scene_digest = core::scene_digest(scene_);
    header.level = core::RecordLevel::kDigest;
    auto stream = core::TraceStream::create(folder / "digest_cost.h5", header);
    if (!stream) return stream.error();
    FrameTaker taker(pipeline_, core::RecordLevel::kDigest, 0, scene_.dt_s);
    for (int k = 0; k < warm_up; ++k)
      if (core::Status s = pipeline_.step(scene_.dt_s); !s) return s;
    for (int block = 0; block < 2 * blocks; ++block) {
      const bool records = block % 2 == 1;
      std::vector<double>& frame_us = records ? recorded_us_ : plain_us_;
      // The first two frames of a block are not counted, because the engine did not know yet that their digests would
      // be read.
      for (int k = 0; k < kBlockFrames + 2; ++k) {
        const Clock::time_point start = Clock::now();
        if (core::Status s = pipeline_.step(scene_.dt_s); !s) return s;
        if (records) {
          auto taken = taker.take();
          if (!taken) return taken.error();
          if (taken.value())
            if (core::Status s = stream.value().append(*std::move(taken).value()); !s) return s;
        }
        if (k < 2) continue;
        frame_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
        double gpu_s = 0.0;
        for (const core::StageTime& stage : pipeline_.stage_times()) {
          gpu_s += stage.seconds;
          StageTimes& times = stage_us_[std::string(stage.stage)];
          (records ? times.recorded : times.plain).push_back(stage.seconds * 1e6);
        }
        (records ? recorded_gpu_us_ : plain_gpu_us_).push_back(gpu_s * 1e6);
      }
    }
    return stream.value().finish();
  }

  void tell(const std::string& name) const {
    // Ratios of neighboring blocks are taken, because bodies change little from one block to the next.
    std::vector<double> extra;
    for (std::size_t k = 0; k + kBlockFrames <= plain_us_.size(); k += kBlockFrames) {
      const auto of = [k](const std::vector<double>& all) {
        return median({all.begin() + static_cast<std::ptrdiff_t>(k),
                       all.begin() + static_cast<std::ptrdiff_t>(k + kBlockFrames)});
      };
      extra.push_back(of(recorded_us_) / of(plain_us_) - 1.0);
    }
    std::printf(
        "{\"scene\": \"%s\", \"frames\": %zu, \"plain_us\": %.2f, \"recorded_us\": %.2f, \"plain_gpu_us\": %.2f, "
        "\"recorded_gpu_us\": %.2f, \"extra_percent\": %.2f, "
        "\"extra_percent_quartiles\": [%.2f, %.2f], \"confirmed\": %llu, \"touching\": %llu, \"faces\": %llu, "
        "\"stages_us\": {",
        name.c_str(), recorded_us_.size(), median(plain_us_), median(recorded_us_), median(plain_gpu_us_),
        median(recorded_gpu_us_), 100.0 * median(extra), 100.0 * at_share(extra, 0.25), 100.0 * at_share(extra, 0.75),
        pipeline_.frame_counts().confirmed, pipeline_.frame_counts().touching, pipeline_.frame_counts().faces);
    const char* before = "";
    for (const auto& [stage, times] : stage_us_) {
      std::printf("%s\"%s\": [%.2f, %.2f]", before, stage.c_str(), median(times.plain), median(times.recorded));
      before = ", ";
    }
    std::printf("}}\n");
    std::fflush(stdout);
  }

 private:
  struct StageTimes {
    std::vector<double> plain;
    std::vector<double> recorded;
  };

  const core::Scene& scene_;
  gpu::Pipeline pipeline_;
  std::vector<double> plain_us_;
  std::vector<double> recorded_us_;
  std::vector<double> plain_gpu_us_;  // by the GPU's clock
  std::vector<double> recorded_gpu_us_;
  std::map<std::string, StageTimes> stage_us_;
};

core::Status measure(const std::string& folder, std::string name, int warm_up, int blocks) {
  const std::string given = name;
  gpu::PipelineOptions options;
  if (name.ends_with("/off")) {
    options.has_vertex_stage = false;
    options.levels = core::Levels::kFlat;
    name.resize(name.size() - 4);
  }
  auto scene = datasets::make_scene(name);
  if (!scene) return scene.error();
  Race race(scene.value(), options);
  if (core::Status s = race.run(folder, warm_up, blocks); !s) return s;
  race.tell(given);
  return core::Done{};
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  if (const std::string why = broadside::gpu::gpu_absent(); !why.empty())
    return std::fprintf(stderr, "%s\n", why.c_str()), 3;
  if (count < 5 || count % 3 != 2)
    return std::fprintf(stderr, "usage: broadside_gpu_digest_cost FOLDER SCENE[/off] WARM_UP_FRAMES BLOCKS...\n"), 2;
  for (int k = 2; k < count; k += 3) {
    const auto status = broadside::bench::measure(given[1], given[k], std::atoi(given[k + 1]), std::atoi(given[k + 2]));
    if (!status.ok()) return std::fprintf(stderr, "%s\n", status.error().line().c_str()), 1;
  }
  return 0;
}
