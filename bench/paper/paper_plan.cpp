#include "bench/paper/paper_plan.hpp"

#include <algorithm>
#include <array>

#include "bench/engines.hpp"
#include "bench/paper/beyond_plan.hpp"
#include "core/nearest_name.hpp"
#include "datasets/published/published_figures.hpp"

namespace broadside::bench::paper {
namespace {

// Statistics are computed from every tenth frame: ten frames in each window of METHOD 9.
constexpr std::uint32_t kRecordEvery = 10;
constexpr std::uint32_t kStackCount = 50;  // Table A1, memory, Figures 4 and A2

constexpr std::array<double, 5> kBetas{0.2, 0.4, 0.6, 0.8, 1.0};
constexpr std::array<double, 5> kDeltas_m{0.0005, 0.001, 0.002, 0.005, 0.01};

bool wants_model(const PlanOptions& options, std::string_view model) {
  return options.models.empty() ||
         std::find(options.models.begin(), options.models.end(), model) != options.models.end();
}

std::string randommove(std::string_view model, std::uint32_t count) {
  return "randommove:" + std::string(model) + ":" + std::to_string(count);
}

PaperCell cell(std::string_view model, std::uint32_t count, std::string scene, std::string method, std::string engine,
               const PlanOptions& options) {
  PaperCell c;
  c.model = model;
  c.count = count;
  c.method = std::move(method);
  c.scene = std::move(scene);
  c.engine = std::move(engine);
  c.frames = options.frames;
  // The last frame is always recorded; a short run still has several before it.
  c.every = std::max(1U, std::min(kRecordEvery, options.frames / 10));
  return c;
}

void add_to(std::vector<PaperCell>& cells, PaperCell c, std::string_view experiment) {
  for (PaperCell& known : cells) {
    if (known.scene != c.scene || known.engine != c.engine || known.beta != c.beta || known.delta_m != c.delta_m ||
        known.method != c.method)
      continue;
    if (std::find(known.experiments.begin(), known.experiments.end(), experiment) == known.experiments.end())
      known.experiments.emplace_back(experiment);
    known.is_timed = known.is_timed || c.is_timed;
    known.wants_memory = known.wants_memory || c.wants_memory;
    return;
  }
  c.experiments.emplace_back(experiment);
  // Inserted after the last cell of the same scene, so that their runs can take turns.
  auto place = cells.end();
  for (auto it = cells.begin(); it != cells.end(); ++it)
    if (it->scene == c.scene && it->beta == c.beta && it->delta_m == c.delta_m) place = it + 1;
  cells.insert(place, std::move(c));
}

// Visits the rows of a published table, or the given counts of each of its models.
template <typename Visit>
void for_rows(std::string_view table_name, const PlanOptions& options, Visit visit) {
  const datasets::PublishedTable& table = datasets::published_table(table_name);
  std::string last_model;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& model = table.text(r, "model");
    if (!wants_model(options, model)) continue;
    if (options.counts.empty()) {
      visit(model, static_cast<std::uint32_t>(table.number(r, "instances")));
    } else if (model != last_model) {
      for (const std::uint32_t count : options.counts) visit(model, count);
    }
    last_model = model;
  }
}

std::string brute(const Device& device, std::string_view levels) {
  return device.octree + "[broad=brute,levels=" + std::string(levels) + "]";
}

void add_table5(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  for_rows("table5", options, [&](const std::string& model, std::uint32_t count) {
    for (const char* level : {"A", "B", "C"})
      add_to(cells, cell(model, count, randommove(model, count), level, brute(device, level), options), "table5");
  });
}

void add_table6(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  for_rows("table6", options, [&](const std::string& model, std::uint32_t count) {
    const std::string scene = randommove(model, count);
    add_to(cells, cell(model, count, scene, "flat", brute(device, "flat"), options), "table6");
    add_to(cells,
           cell(model, count, scene, "flat, no vertices", device.octree + "[broad=brute,levels=flat,vertex_stage=off]",
                options),
           "table6");
    add_to(cells, cell(model, count, scene, "C", brute(device, "C"), options), "table6");
  });
}

void add_stacks(const PlanOptions& options, const Device& device, std::string_view experiment, bool wants_memory,
                std::vector<PaperCell>& cells) {
  for (const std::string& model : paper_models()) {
    if (!wants_model(options, model)) continue;
    const std::vector<std::uint32_t> counts =
        options.counts.empty() ? std::vector<std::uint32_t>{kStackCount} : options.counts;
    for (const std::uint32_t count : counts) {
      for (const bool is_hash : {true, false}) {
        PaperCell c = cell(model, count, "freefall:" + model + ":" + std::to_string(count), is_hash ? "hash" : "octree",
                           is_hash ? device.hash : device.beside_hash, options);
        c.wants_memory = wants_memory;
        c.is_timed = !wants_memory;
        add_to(cells, std::move(c), experiment);
      }
    }
  }
}

void add_table_a1(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  add_stacks(options, device, "tableA1", false, cells);
}

void add_memory(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  add_stacks(options, device, "memory", true, cells);
}

void add_figure4(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  for_rows("figure4", options, [&](const std::string& model, std::uint32_t count) {
    const std::string scene = randommove(model, count);
    add_to(cells, cell(model, count, scene, "level 1", brute(device, "level1"), options), "figure4");
    add_to(cells, cell(model, count, scene, "level 2", brute(device, "A"), options), "figure4");
  });
}

// The pictures need meshes and no cells.
void add_figure_a1(const PlanOptions&, const Device&, std::vector<PaperCell>&) {}

void add_figure_a2(const PlanOptions& options, const Device& device, std::vector<PaperCell>& cells) {
  const std::string model = options.models.empty() ? "bunny" : options.models.front();
  const std::uint32_t count = options.counts.empty() ? kStackCount : options.counts.front();
  for (const double beta : kBetas) {
    for (const double delta_m : kDeltas_m) {
      PaperCell c =
          cell(model, count, "freefall:" + model + ":" + std::to_string(count), "octree", device.octree, options);
      c.beta = beta;
      c.delta_m = delta_m;
      c.is_timed = false;
      add_to(cells, std::move(c), "figureA2");
    }
  }
}

constexpr std::array<ExperimentRow, 8> kExperiments{{
    {"table5", "Levels A, B and C of the body octree (P-Table 5)", true, add_table5},
    {"table6", "One box a body against the hierarchy C (P-Table 6)", true, add_table6},
    {"tableA1", "Spatial hash against octree, free fall (P-Table A1, Figure 5)", true, add_table_a1},
    {"memory", "Memory of spatial hash and octree", true, add_memory},
    {"figure4", "Level 1 against level 2 (Figure 4)", true, add_figure4},
    {"figureA1", "Body octrees, level by level (Figure A1)", true, add_figure_a1},
    {"figureA2", "Mean penetration over beta and delta (Figure A2)", true, add_figure_a2},
    {"beyond", "Up to 100 times the bodies; Bullet's and FCL's broad phases beside them", false, add_beyond},
}};

bool runs_here(const std::string& id, std::string* why) {
  auto row = find_engine(id);
  if (!row) {
    *why = "this program has no " + id;
    return false;
  }
  *why = row.value()->absent != nullptr ? row.value()->absent() : "";
  return why->empty();
}

}  // namespace

std::span<const ExperimentRow> experiments() {
  return kExperiments;
}

std::span<const double> penetration_betas() {
  return kBetas;
}

std::span<const double> penetration_deltas_m() {
  return kDeltas_m;
}

std::vector<std::string> paper_models() {
  std::vector<std::string> models;
  const datasets::PublishedTable& table = datasets::published_table("memory");
  for (std::size_t r = 0; r < table.rows.size(); ++r) models.push_back(table.text(r, "model"));
  return models;
}

bool takes_turns(const PaperCell& a, const PaperCell& b) {
  return a.scene == b.scene && a.beta == b.beta && a.delta_m == b.delta_m && a.frames == b.frames && a.every == b.every;
}

core::Result<Device> choose_device(const std::string& wanted) {
  constexpr std::array<std::string_view, 2> kOctrees{"octree-gpu", "octree-cpu"};
  if (!wanted.empty() && std::find(kOctrees.begin(), kOctrees.end(), wanted) == kOctrees.end())
    return core::Error{"the paper's experiments do not run on '" + wanted + "'", "--engine",
                       core::advise_name(wanted, kOctrees)};
  std::string why_no_gpu;
  const bool has_gpu = runs_here("octree-gpu", &why_no_gpu);
  if (wanted == "octree-gpu" && !has_gpu)
    return core::Error{"not measured: " + why_no_gpu, "octree-gpu", "leave --engine out to take octree-cpu",
                       core::Exit::kMissing};
  if (!has_gpu || wanted == "octree-cpu")
    return Device{"octree-cpu", "hash-cpu", "octree-cpu",
                  has_gpu ? "All of it ran on octree-cpu, the twin on CPU threads, as asked."
                          : "All of it ran on octree-cpu, the twin on CPU threads: " + why_no_gpu + "."};
  std::string why_no_hash;
  if (runs_here("hash-gpu", &why_no_hash))
    return Device{"octree-gpu", "hash-gpu", "octree-gpu", "All of it ran on the GPU: octree-gpu and hash-gpu."};
  return Device{"octree-gpu", "hash-cpu", "octree-cpu",
                "octree-gpu ran on the GPU. Spatial hash and octree are compared on the CPU (hash-cpu, octree-cpu), so "
                "that both have the same device: " +
                    why_no_hash + "."};
}

core::Result<std::vector<PaperCell>> plan_cells(const std::vector<std::string>& names, const PlanOptions& options,
                                                const Device& device) {
  std::vector<std::string_view> known;
  known.reserve(std::size(kExperiments));
  for (const ExperimentRow& row : kExperiments) known.push_back(row.id);
  const std::vector<std::string> models = paper_models();
  const std::vector<std::string_view> model_names(models.begin(), models.end());
  for (const std::string& model : options.models)
    if (std::find(models.begin(), models.end(), model) == models.end())
      return core::Error{"the paper has no model '" + model + "'", "--models", core::advise_name(model, model_names)};
  std::vector<PaperCell> cells;
  for (const std::string& name : names) {
    bool is_known = name == "all";
    for (const ExperimentRow& row : kExperiments) {
      if (name != row.id && !(name == "all" && row.is_of_paper)) continue;
      row.add(options, device, cells);
      is_known = true;
    }
    if (!is_known) return core::Error{"no experiment '" + name + "'", "paper", core::advise_name(name, known)};
  }
  return cells;
}

}  // namespace broadside::bench::paper
