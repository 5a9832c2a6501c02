// What a contest compares: engines of dynamics on scenes with known answers, each at several steps.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/campaign/campaign_file.hpp"
#include "core/result.hpp"

namespace broadside::bench::contest {

struct ContestRequest {
  std::vector<std::string> engines;  // empty = default_entrants()
  std::vector<std::string> scenes;   // names, or a beginning that ends in ':' or '*'; empty = default_scenes()
  // Factors of the scene's own step, rising. The matrix of verdicts shows the scene's own, 1. Where no scenes are
  // named, one scene of each kind runs at all of these steps and the others at their own; those that stand by statics
  // also run at 1/60 s.
  std::vector<double> step_factors{0.25, 0.5, 1.0, 2.0};
  std::uint32_t repetitions = 1;   // timed runs of a cell; 0 = none
  double time_limit_s = 120.0;     // of each part of a cell
  bool has_largest_heaps = false;  // 10,000 boxes too; without scenes of your own
};

// An engine that was asked for, and why it cannot run here.
struct Entrant {
  std::string engine;        // "jolt[gyroscopic=1]"
  std::string absent;        // empty = it is here
  bool has_threads = false;  // a number of threads is one of its settings
};

// Engines of dynamics whose bodies turn, with the settings that matter, in the order of the page's columns.
std::vector<std::string_view> default_entrants();
// Those with answers (rigid:*), and heaps.
std::vector<std::string> default_scenes();

// Scenes whose energy is shown over time: those that run at every step, or those that were asked for.
core::Result<std::vector<std::string>> scenes_with_energy(const ContestRequest& request);

core::Result<std::vector<Entrant>> entrants_of(const ContestRequest& request);
core::Result<std::vector<std::string>> scenes_of(const ContestRequest& request);

// "rigid:bounce" at half of its step of 1/60 s: "rigid:bounce@1/120". At its own step the name alone.
std::string scene_at(const std::string& scene, double dt_s, double factor);

// The cells: scenes outermost, then engines, then steps. Only entrants that are here.
core::Result<campaign::CampaignFile> contest_campaign(const ContestRequest& request);

}  // namespace broadside::bench::contest
