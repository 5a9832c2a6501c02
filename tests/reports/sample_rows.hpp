// Rows as a run of the free-fall scene leaves them: a dozen cells, some failing, some absent, some timed. Figures are
// invented, and deterministic, so that every kind of thing that a page can show occurs in it.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/contact.hpp"
#include "core/pair.hpp"
#include "core/rows.hpp"

namespace broadside::reports::testing_rows {

inline core::Stamp stamp_of(const std::string& engine, const std::string& settings_short) {
  return {.scene_name = "freefall:bunny:50",
          .scene_digest = 0x5d1f0c9b7a3e2468ULL,
          .engine = engine,
          .settings = "broad=tree,levels=C,solver=colored,variant=sound;" + settings_short,
          .settings_short = settings_short,
          .engine_build = engine.starts_with("bullet") ? "Bullet 3.24, float"
                          : engine.starts_with("fcl")  ? "FCL 0.7.0, libccd 2.1, double"
                                                       : "Broadside, float, oneTBB 2021.8",
          .broadside_build = "0.1.0, commit 3f2a9c1, g++ 12.2.0, -O3 -ffp-contract=off",
          .machine = "Intel Xeon 2.80 GHz, 2 cores, 7.8 GiB, Debian 12, no device"};
}

inline const std::vector<std::string>& validator_names() {
  static const std::vector<std::string> names{"candidate-set",   "level-agreement", "proximity-bound", "contact-normal",
                                              "contraction",     "center-of-mass",  "restitution",     "normal-energy",
                                              "friction-energy", "velocity-cap",    "determinism",     "state-sanity",
                                              "capacity",        "metamorphic"};
  return names;
}

// A number in [0, 1) that depends on k alone.
inline double noise(std::uint64_t k) {
  return static_cast<double>(core::splitmix64(k) >> 11) * 0x1.0p-53;
}

inline core::Verdict verdict_of(std::size_t validator, bool is_dynamics, std::uint64_t seed) {
  static const std::vector<std::string> units{"pairs", "pairs", "m",   "rad",    "m", "kg m",  "m/s",
                                              "J",     "J",     "m/s", "frames", "",  "pairs", "m"};
  const std::string& name = validator_names()[validator];
  core::Verdict v{.validator = name};
  const bool is_of_dynamics = validator >= 1 && validator <= 9;
  if (!is_dynamics && is_of_dynamics && validator != 2) {
    v.explanation = "the trace has no contacts: the engine was fed boxes and offers a broad phase alone";
    return v;
  }
  v.outcome = core::Outcome::kPass;
  v.unit = units[validator];
  const bool is_count = v.unit == "pairs" || v.unit == "frames";
  v.limit = is_count ? 0.0 : 1.2e-5 * (1.0 + noise(validator));
  v.measured = is_count ? 0.0 : v.limit * noise(seed * 31 + validator);
  v.origin = is_count
                 ? "the exact set of the recorded boxes: no rounding is involved"
                 : "8 ulp of the largest term, from the rounding model of float32 sums in the order of application";
  v.explanation = "every frame was compared with the law " + name + " states";
  v.worst = {
      .step = static_cast<std::int64_t>(1 + 2999 * noise(seed + validator)),
      .bodies = {static_cast<std::uint32_t>(25 * noise(seed)), static_cast<std::uint32_t>(25 + 25 * noise(seed + 1))},
      .field = is_count ? "pairs" : "contact"};
  v.checked = 3000 * (40 + validator * 13);
  if (name == "candidate-set" || name == "determinism")
    v.baseline = name == "candidate-set" ? "all-pairs" : "octree-cpu[threads=2]";
  return v;
}

inline core::Sample sample_of(const core::Cell& cell, const std::vector<std::pair<std::string, double>>& stage_ms,
                              std::uint32_t repetition, std::size_t frames) {
  core::Sample s{.stamp = cell.stamp, .repetition = repetition, .process = repetition + 1, .warm_up_frames = 100};
  std::vector<double> whole(frames, 0.0);
  for (std::size_t k = 0; k < stage_ms.size(); ++k) {
    core::StageSeries series{stage_ms[k].first, {}};
    for (std::size_t f = 0; f < frames; ++f) {
      const double ramp = 0.6 + 0.4 * static_cast<double>(f) / static_cast<double>(frames);
      const double jitter = 1.0 + 0.12 * (noise(f * 977 + k * 13 + repetition) - 0.5);
      series.seconds.push_back(stage_ms[k].second * 1e-3 * ramp * jitter);
      whole[f] += series.seconds.back() * 1.01;
    }
    s.stages.push_back(std::move(series));
  }
  s.stages.push_back({"frame", whole});
  s.final_step = cell.frames;
  s.final_digest = cell.digests.at(cell.frames);
  return s;
}

inline core::RunRows sample_rows() {
  core::RunRows rows;
  struct Plan {
    std::string engine, settings;
    bool is_dynamics;
    double scale;  // of the times; 0 = not timed
  };
  const std::vector<Plan> plans{{"octree-cpu", "", true, 1.0},
                                {"octree-cpu", "levels=flat", true, 1.7},
                                {"octree-cpu", "levels=level1", true, 1.25},
                                {"octree-cpu", "levels=A", true, 2.9},
                                {"octree-cpu", "levels=B", true, 1.1},
                                {"octree-cpu", "variant=printed-E3", true, 0.98},
                                {"all-pairs", "", false, 0.0},
                                {"bullet-dbvt", "", false, 0.05},
                                {"fcl-tree", "", false, 0.3},
                                {"fcl-mesh", "", false, 0.0}};
  std::uint64_t seed = 1;
  for (const Plan& plan : plans) {
    core::Cell cell{.stamp = stamp_of(plan.engine, plan.settings), .state = core::CellState::kRecorded, .frames = 3000};
    cell.trace_file = plan.engine + (plan.settings.empty() ? "" : "-" + plan.settings) + ".h5";
    cell.wall_s = 4.0 + 9.0 * noise(seed);
    cell.digests[3000] = core::splitmix64(seed);
    cell.notes = {
        {"mesh", "bunny_closed_2486v_4968t.ply, 2486 vertices, 4968 triangles"},
        {"mesh sha256", "2064919e798919c35c3ea81e7a28481ece0bb23c73cf84849927b9b007ae8ce9"},
        {"stand-in",
         "the closed bunny of the distribution's package, decimated, in place of the paper's 2527-vertex one"},
        {"bodies", "50"},
        {"dt", "1/60 s"},
        {"theta", "0.0312 m, the mean edge length of the two meshes"},
        {"pairs: candidates, mean", plan.is_dynamics ? "61.4" : "61.4"},
        {"pairs: candidates, largest", "148"},
        {"command", "broadside run freefall:bunny:50 --engine " + plan.engine +
                        (plan.settings.empty() ? "" : " --set " + plan.settings)}};
    if (plan.is_dynamics) cell.notes["pairs: confirmed, mean"] = "44.9";
    if (plan.engine == "fcl-mesh") cell.notes["frames measured"] = "every 100th: 100, 200, ... 3000";
    core::CellVerdicts judged{.trace_file = cell.trace_file, .stamp = cell.stamp};
    for (std::size_t v = 0; v < validator_names().size(); ++v)
      judged.verdicts.push_back(verdict_of(v, plan.is_dynamics, seed));
    if (plan.settings == "variant=printed-E3") {
      core::Verdict& v = judged.verdicts[5];
      v.outcome = core::Outcome::kFail;
      v.measured = 0.0183;
      v.violations = 71294;
      v.explanation = "position correction moved the common center of mass of a pair";
      v.worst = {.step = 412, .bodies = {3, 17}, .field = "contact.post.x"};
      core::Verdict& restitution = judged.verdicts[6];
      restitution.outcome = core::Outcome::kFail;
      restitution.measured = std::nan("");
      restitution.worst = {.step = 518, .bodies = {9, core::kFirstFace + 2}, .field = "contact.post.v"};
      restitution.violations = 3;
    }
    if (plan.engine == "fcl-mesh") {
      core::Verdict& v = judged.verdicts[2];
      v.outcome = core::Outcome::kInconclusive;
      v.explanation = "14 of 4410 pairs lie inside the touching band, where the sign of the distance is rounding";
      v.violations = 14;
    }
    rows.verdicts.push_back(std::move(judged));
    if (plan.scale > 0.0) {
      const double s = plan.scale;
      const std::vector<std::pair<std::string, double>> whole{{"integrate", 0.011 * s}, {"boxes", 0.018 * s},
                                                              {"broad", 0.041 * s},     {"refine", 0.33 * s},
                                                              {"vertex", 1.42 * s},     {"response", 0.062 * s}};
      for (std::uint32_t r = 0; r < 5; ++r)
        rows.samples.push_back(sample_of(cell,
                                         plan.is_dynamics
                                             ? whole
                                             : std::vector<std::pair<std::string, double>>{{"update", 0.4 * s},
                                                                                           {"find", 0.7 * s},
                                                                                           {"filter", 0.1 * s}},
                                         r, 300));
      if (plan.settings == "levels=B") rows.samples.back().final_digest ^= 1;
    }
    rows.cells.push_back(std::move(cell));
    ++seed;
  }
  for (const std::string engine : {"octree-gpu", "hash-gpu"}) {
    core::Cell cell{.stamp = stamp_of(engine, ""), .state = core::CellState::kNotMeasured, .reason = "no device"};
    rows.cells.push_back(std::move(cell));
  }
  rows.cells.push_back({.stamp = stamp_of("ccd", ""),
                        .state = core::CellState::kCrashed,
                        .reason = "signal 6 (abort) after frame 12: an assertion of the library",
                        .frames = 12,
                        .wall_s = 0.4});
  return rows;
}

}  // namespace broadside::reports::testing_rows
