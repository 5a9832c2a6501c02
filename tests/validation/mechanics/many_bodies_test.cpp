// Ten thousand boxes, each frame judged: nothing is left out, and the time is printed.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/contact.hpp"
#include "tests/validation/mechanics/one_step.hpp"
#include "validation/judge.hpp"

namespace broadside::tests {
namespace {

// Columns of ten boxes that rest on the floor, 1 mm apart, and above them as many boxes that fall and spin. Frames are
// made when they are read, so that memory is that of the judge.
class ManyBoxes {
 public:
  explicit ManyBoxes(int columns) : columns_(columns) {
    bench::Specimen r = one_step(static_cast<std::size_t>(kHeight + 1) * columns * columns);
    header_ = r.header;
    header_.declaration = core::Declaration::of({{"detection_at", "start"}, {"contacts", "totals"}});
    header_.groups |= core::bit(core::Group::kPoints) | core::bit(core::Group::kDetection) |
                      core::bit(core::Group::kDetectedOrientation);
    core::Scene& scene = header_.scene;
    const float width = 1.001F * static_cast<float>(columns);
    scene.domain = {{-1, 0, -1}, {width + 1, 1e5F, width + 1}};
    scene.parameters.delta_m = 0.0F;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      core::Body& b = scene.bodies[i];
      const std::size_t column = i / (kHeight + 1);
      const std::size_t level = i % (kHeight + 1);
      const float x = 1.001F * static_cast<float>(column / columns) + 0.5F;
      const float z = 1.001F * static_cast<float>(column % columns) + 0.5F;
      b.position = {x, level < kHeight ? 0.5F + static_cast<float>(level) : 5e4F, z};
      if (level == kHeight) b.angular_velocity = {0, 4, 0};
      if (level == kHeight) b.position.x = 2 * x, b.position.z = 2 * z;
    }
    scene.domain.max.x = scene.domain.max.z = 2 * width + 2;
  }

  [[nodiscard]] const core::TraceHeader& header() const { return header_; }
  [[nodiscard]] std::uint64_t pairs_of_columns() const {
    return static_cast<std::uint64_t>(kHeight - 1) * columns_ * columns_;
  }

  [[nodiscard]] core::FrameRecord frame(std::uint64_t step) const {
    bench::Specimen r;
    r.header = header_;
    const double t = kStep * static_cast<double>(step);
    core::FrameRecord& f = end_step(r, [&](core::WideStates& s) { fall(s, t); });
    bench::Specimen before;
    before.header = header_;
    const core::FrameRecord& start = end_step(before, [&](core::WideStates& s) { fall(s, t - kStep); });
    f.step = step;
    f.time_s = t;
    f.detected_position = start.position;
    f.detected_velocity = start.velocity;
    f.detected_orientation = start.orientation;
    for (const core::Vec3 x : start.position) f.boxes.push_back({x - core::Vec3{1, 1, 1}, x + core::Vec3{1, 1, 1}});
    add_points(f);
    return f;
  }

 private:
  static constexpr int kHeight = 10;

  void fall(core::WideStates& s, double t) const {
    for (std::size_t i = kHeight; i < s.position.size(); i += kHeight + 1) {
      s.position[i].y -= 0.5 * kG * t * t;
      s.velocity[i].y = -kG * t;
      s.orientation[i] = {std::cos(2 * t), 0, std::sin(2 * t), 0};
    }
  }

  // Level k carries the boxes above it.
  void add_points(core::FrameRecord& f) const {
    for (std::uint32_t i = 0; i < f.position.size(); ++i) {
      const std::uint32_t level = i % (kHeight + 1);
      if (level == kHeight) continue;
      const float weight = static_cast<float>(kG * kStep) * static_cast<float>(kHeight - level) / 4.0F;
      for (const float dx : {-0.5F, 0.5F})
        for (const float dz : {-0.5F, 0.5F}) {
          core::ContactPoint p;
          p.a = i;
          p.b = level == 0 ? core::kFirstFace + 2 : i - 1;
          p.point = f.detected_position[i] + core::Vec3{dx, -0.5F, dz};
          p.normal = {0, 1, 0};
          p.impulse = {0, weight, 0};
          f.points.push_back(p);
        }
    }
  }

  core::TraceHeader header_;
  int columns_;
};

void judge_frames(int columns, std::uint64_t frames) {
  const ManyBoxes boxes(columns);
  std::vector<std::uint64_t> steps(frames);
  std::iota(steps.begin(), steps.end(), 1U);
  const validation::FrameSource source{boxes.header(), steps, [&](std::uint64_t k, std::uint32_t) {
                                         return core::Result<core::FrameRecord>(boxes.frame(k + 1));
                                       }};
  validation::JudgeOptions options;
  for (const validation::ValidatorRow& row : validation::validators())
    if (row.reads_motion) options.only.emplace_back(row.name);
  const auto start = std::chrono::steady_clock::now();
  const auto verdicts = validation::judge(source, nullptr, options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(verdicts.ok()) << verdicts.error().line();
  for (const core::Verdict& v : verdicts.value()) {
    EXPECT_NE(v.outcome, core::Outcome::kFail) << told(v);
    if (v.validator != "penetration") continue;
    EXPECT_GE(v.checked, frames * boxes.pairs_of_columns()) << "pairs were left out";
  }
  std::printf("%zu bodies, %llu frames: %.2f s\n", boxes.header().scene.bodies.size(),
              static_cast<unsigned long long>(frames), seconds);
}

TEST(ManyBodies, AreJudgedPairByPair) {
  judge_frames(4, 10);
}

TEST(ManyBodies, SlowTenThousandAreJudgedPairByPair) {
  judge_frames(31, 100);
}

}  // namespace
}  // namespace broadside::tests
