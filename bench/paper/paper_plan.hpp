// Which cells each experiment of the paper needs: METHOD section 9 as a list of (scene, engine, settings).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::paper {

// The engines that the experiments run on, and why these were chosen.
struct Device {
  std::string octree;       // "octree-gpu" or "octree-cpu"
  std::string hash;         // "hash-gpu" or "hash-cpu"
  std::string beside_hash;  // the octree engine on the hash's device, for Table A1
  std::string words;        // one sentence for reports
};

// The best engines of this machine, or those that `wanted` names: "octree-gpu", "octree-cpu"; empty = best. An engine
// that cannot run here is an error with the reason.
core::Result<Device> choose_device(const std::string& wanted);

struct PaperCell {
  std::vector<std::string> experiments;
  std::string model;
  std::uint32_t count = 0;
  std::string method;
  std::string scene;   // "randommove:bunny:300"
  std::string engine;  // "octree-cpu[broad=brute,levels=A]"
  double beta = 0.0;   // for Figure A2: the scene with these parameters and dt = 0.001 s; 0 elsewhere
  double delta_m = 0.0;
  std::uint64_t frames = 0;
  std::uint32_t every = 1;  // record every k-th frame
  bool is_timed = true;
  bool wants_memory = false;
  std::string left_out;  // why the cell is not tried; empty when it is
  // In a campaign: the id of the cell, and the text that it shares with the cells that are timed in turns with it.
  std::string id;
  std::string turns;
};

// Whether both cells have one scene and are recorded alike, so that their runs take turns.
bool takes_turns(const PaperCell& a, const PaperCell& b);

struct PlanOptions {
  std::vector<std::string> models;    // empty = the paper's four
  std::vector<std::uint32_t> counts;  // empty = the paper's counts, which differ by model
  std::uint32_t frames = 3000;
  std::uint32_t runs = 5;
  double limit_s = 60.0;  // cells beyond the paper that are expected to take longer are left out
};

struct ExperimentRow {
  std::string_view id;  // "table5"
  std::string_view title;
  bool is_of_paper;  // and so part of "all"
  void (*add)(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells);
};

std::span<const ExperimentRow> experiments();

// The cells of these experiments ("all" = every one), each cell once, cells of one scene next to each other. An unknown
// name is an error that names the nearest known one; so is a model that the paper does not have.
core::Result<std::vector<PaperCell>> plan_cells(const std::vector<std::string>& names, const PlanOptions& options,
                                                const Device& device);

// The paper's models, in its order.
std::vector<std::string> paper_models();

// The values of beta in Figure A2.
std::span<const double> penetration_betas();
std::span<const double> penetration_deltas_m();

}  // namespace broadside::bench::paper
