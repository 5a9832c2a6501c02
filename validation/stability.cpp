#include "validation/stability.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "validation/rounding.hpp"
#include "validation/spring_motion.hpp"
#include "validation/subject_facts.hpp"
#include "validation/tally.hpp"

namespace broadside::validation {
namespace {

class Stability final : public Validator {
 public:
  explicit Stability(const Subject& subject) : scene_(subject.header.scene), dt_(scene_.dt_s) {
    for (Oscillator& o : oscillators(scene_)) tracks_.push_back({std::move(o), StepPowers(0.0, 0.0, 0.0)});
  }

  void look(const Evidence& evidence) override {
    const core::FrameRecord& frame = evidence.frame;
    const std::size_t n = scene_.bodies.size();
    if (frame.detected_position.size() != n || frame.detected_velocity.size() != n) return;
    const core::FrameRecord* before = evidence.previous;
    const bool follows = before != nullptr && before->position.size() == n && before->velocity.size() == n;
    for (Track& track : tracks_) {
      const std::uint32_t i = track.oscillator.body;
      judge_step(track, frame.step);
      if (frame.step == 1)
        judge_frame(track, Vec3d(scene_.bodies[i].position), Vec3d(scene_.bodies[i].velocity), frame);
      else if (follows)
        judge_frame(track, Vec3d(before->position[i]), Vec3d(before->velocity[i]), frame);
      else
        track.is_running = false;
      // A contact or the velocity cap changed the state before the frame's end: the amplitude starts anew from there.
      const bool is_left_alone = frame.position.size() == n && frame.velocity.size() == n &&
                                 frame.position[i] == frame.detected_position[i] &&
                                 frame.velocity[i] == frame.detected_velocity[i];
      if (!is_left_alone) track.is_running = false;
    }
  }

  core::Verdict conclude() override {
    return tally_.conclude("no frames", std::to_string(tracks_.size()) + " bodies on springs, largest amplitude " +
                                            number_text(largest_) + " times that of its start");
  }

 private:
  struct Track {
    Oscillator oscillator;
    StepPowers powers;
    bool is_running = false;
    double start = 0.0;     // amplitude, m/s
    double rounding = 0.0;  // over all steps since, m/s
  };

  void judge_step(const Track& track, std::uint64_t step) {
    tally_.check(dt_, {track.oscillator.step_limit(), "s", "METHOD 1: dt < 2 / (sqrt(w0^2 + (g/2)^2) + g/2)"},
                 Where::body(step, track.oscillator.body, "scene.dt_s"));
  }

  void judge_frame(Track& track, Vec3d x0, Vec3d v0, const core::FrameRecord& frame) {
    const Oscillator& o = track.oscillator;
    const Vec3d x1(frame.detected_position[o.body]);
    const Vec3d v1(frame.detected_velocity[o.body]);
    Vec3d acceleration(scene_.gravity_m_s2);
    double size = length(acceleration);
    for (const core::Spring& s : o.springs) {
      const Vec3d reach = Vec3d(s.anchor) - x0;
      const double k = s.stiffness_n_m;
      const double c = s.damping_n_s_m;
      acceleration = acceleration + (o.w * k) * reach - (o.w * c) * v0;
      size += o.w * (k * length(reach) + c * length(v0));
    }
    const double v_limit =
        rounding(acceleration_operations(o.springs.size())) * dt_ * size + rounding(1) * length(v1) + 8.0 * kSubnormal;
    const double x_limit = rounding(1) * (length(x1) + dt_ * length(v1)) + 8.0 * kSubnormal;
    tally_.check(length(v1 - (v0 + dt_ * acceleration)),
                 {v_limit, "m/s", "P(1), P(2): 5 operations and one a spring on dt A, one addition (float32)"},
                 Where::body(frame.step, o.body, "detection.velocity"));
    tally_.check(length(x1 - (x0 + dt_ * v1)), {x_limit, "m", "P(3): one product and one addition (float32)"},
                 Where::body(frame.step, o.body, "detection.position"));
    if (o.stiffness > 0.0) judge_amplitude(track, x0, v0, o.amplitude(x1, v1), o.w0() * x_limit + v_limit, frame.step);
  }

  void judge_amplitude(Track& track, Vec3d x0, Vec3d v0, double amplitude, double rounded, std::uint64_t step) {
    const Oscillator& o = track.oscillator;
    if (!track.is_running) {
      track.is_running = true;
      track.start = o.amplitude(x0, v0);
      track.rounding = 0.0;
      // Above the limit the powers have no bound; 1 is the bound of the true motion.
      track.powers = dt_ < o.step_limit() ? StepPowers(o.w0(), o.g(), dt_) : StepPowers(0.0, 0.0, 0.0);
    }
    track.powers.advance();
    track.rounding += rounded;
    const double limit = track.powers.bound() * (track.start + track.rounding);
    tally_.check(amplitude, {limit, "m/s", "bounded: |M^t| times the amplitude at the start, and rounding carried on"},
                 Where::body(step, o.body, "detection: amplitude"));
    if (track.start > 0.0) largest_ = std::max(largest_, amplitude / track.start);
  }

  const core::Scene& scene_;
  double dt_;
  std::vector<Track> tracks_;
  Tally tally_{"stability", "steps, states and amplitudes", "METHOD 1: dt < 2 / (sqrt(w0^2 + (g/2)^2) + g/2)"};
  double largest_ = 0.0;
};

std::string why_not_stability(const Subject& subject) {
  if (oscillators(subject.header.scene).empty()) return "the scene has no springs";
  if (std::string text = lacking(subject.header, core::bit(core::Group::kDetection)); !text.empty()) return text;
  return subject.header.driver.empty() ? "" : "the states come from another engine";
}

}  // namespace

ValidatorRow stability_row() {
  return {"stability",
          "the time step is below the limit of every spring, and bodies on springs move as the method says and stay "
          "bounded",
          "printed-E1; a step above the sound limit",
          core::bit(core::Group::kBodies) | core::bit(core::Group::kDetection),
          0,
          why_not_stability,
          [](const Subject& subject) -> std::unique_ptr<Validator> { return std::make_unique<Stability>(subject); }};
}

}  // namespace broadside::validation
