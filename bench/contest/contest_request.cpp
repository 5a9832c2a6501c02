#include "bench/contest/contest_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "bench/cell/cell_spec.hpp"
#include "bench/cell/scene_arguments.hpp"
#include "bench/contest/passage_courses.hpp"
#include "bench/contest/tunings.hpp"
#include "bench/engines.hpp"
#include "core/nearest_name.hpp"
#include "datasets/scenes.hpp"

namespace broadside::bench::contest {
namespace {

// Each engine as it ships and as its manual recommends (tunings.cpp). More settings where the default leaves out what
// other engines have, or where a setting selects another method.
constexpr std::array<std::string_view, 26> kEntrants{"octree-cpu",
                                                     "plain-rigid",
                                                     "bullet-world",
                                                     "bullet-world[iterations=50]",
                                                     "ode-world",
                                                     "ode-world[tuning=recommended]",
                                                     "ode-world[solver=dantzig]",
                                                     "dart-world",
                                                     "mujoco-world",
                                                     "mujoco-world[tuning=recommended]",
                                                     "mujoco-world[integrator=rk4]",
                                                     "simbody-world[tuning=shipped]",
                                                     "simbody-world",
                                                     "jolt",
                                                     "jolt[tuning=1]",
                                                     "jolt[gyroscopic=1]",
                                                     "rapier",
                                                     "rapier[iterations=16]",
                                                     "mujoco3",
                                                     "mujoco3[tuning=1]",
                                                     "mujoco3[integrator=2]",
                                                     "cannon",
                                                     "cannon[iterations=50]",
                                                     "physx",
                                                     "physx[tuning=1]",
                                                     "physx[gyroscopic=1]"};

// Families whose scenes have answers, and scenes that engines are compared on without one.
constexpr std::string_view kFamily = "rigid:";
constexpr std::array<std::string_view, 2> kHeaps{"freefall:cube:100[rigid=1,frames=240]",
                                                 "freefall:cube:1000[rigid=1,frames=240]"};
constexpr std::string_view kLargestHeap = "freefall:cube:10000[rigid=1,frames=120]";

// Scenes on which engines that have a number of threads run with one and with two.
constexpr std::array<std::string_view, 2> kOfThreads{"rigid:stack:5", kHeaps[0]};

// The default scenes that run at every step: each kind of motion once, so that the whole contest takes an hour.
constexpr std::array<std::string_view, 9> kAtEveryStep{
    "rigid:torque-free:box",     "rigid:spin-up", "rigid:incline:slide", "rigid:slide:heading-3",
    "rigid:sphere:slip-to-roll", "rigid:bounce",  "rigid:stack:5",       "rigid:stack:1000-on-1",
    "rigid:card-tent:stands"};

// The step that games take. Scenes that stand by statics run at it too, with engines as they ship and as recommended.
constexpr double kUsualStep_s = 1.0 / 60.0;

// Shares of the scene's own step, the usual one included where it is longer and the scene stands by statics.
std::vector<double> steps_of(const ContestRequest& request, const std::string& name, const core::Scene& scene,
                             std::string_view engine) {
  if (!request.scenes.empty()) return request.step_factors;
  const bool is_at_every = std::find(kAtEveryStep.begin(), kAtEveryStep.end(), name) != kAtEveryStep.end();
  std::vector<double> factors =
      is_at_every && !is_recommended(engine) ? request.step_factors : std::vector<double>{1.0};
  // Steps are float32 in a scene.
  const double usual = std::round(kUsualStep_s / static_cast<double>(scene.dt_s));
  const bool has_it = std::find(factors.begin(), factors.end(), usual) != factors.end();
  if (scene.answer == "stands" && usual > 1.0 && !has_it) factors.push_back(usual);
  return factors;
}

bool begins_with_one_of(std::string_view name, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [name](const std::string& b) { return name.starts_with(b); });
}

// "1/240" where the step is a whole part of a second, else its shortest decimal.
std::string step_text(double dt_s) {
  const double parts = std::round(1.0 / dt_s);
  return std::abs(parts * dt_s - 1.0) < 1e-6 ? fmt::format("1/{:.0f}", parts)
                                             : fmt::format("{}", static_cast<float>(dt_s));
}

// "a[b=1]" with 2 threads: "a[b=1,threads=2]".
std::string with_threads(const std::string& engine, const std::string& threads) {
  if (engine.ends_with(']')) return engine.substr(0, engine.size() - 1) + ",threads=" + threads + "]";
  return engine + "[threads=" + threads + "]";
}

// Adds the runs of passages that are not in the campaign yet. They are judged and not timed: the cost of an impact is
// measured at the scene's own step.
void add_passages(campaign::CampaignFile& campaign, const std::vector<Entrant>& entrants, double time_limit_s) {
  std::set<std::pair<std::string, std::string>> there;
  for (const campaign::CellWork& work : campaign.cells) there.emplace(work.scene, work.engine);
  for (const PassageCourse& course : passage_courses())
    for (const PassageRun& run : course.runs)
      for (const Entrant& entrant : entrants) {
        if (!entrant.absent.empty() || is_recommended(entrant.engine)) continue;
        if (there.count({run.scene, entrant.engine}) > 0) continue;
        campaign::CellWork work;
        work.scene = run.scene;
        work.engine = entrant.engine;
        work.repetitions = 0;
        work.stand_in = true;
        work.time_limit_s = time_limit_s;
        campaign.cells.push_back(std::move(work));
      }
}

core::Status complete(Entrant& entrant) {
  const std::string id = entrant.engine.substr(0, entrant.engine.find('['));
  auto row = find_engine(id);
  if (!row) return row.error();
  if (!offers(*row.value(), "dynamics"))
    return core::Error{"it offers no dynamics, so a contest has no motion to compare", id,
                       "see 'broadside list engines'"};
  entrant.absent = why_absent(*row.value());
  if (!entrant.absent.empty()) return core::Done{};
  const auto settings_of_it = row.value()->settings;
  entrant.has_threads = std::any_of(settings_of_it.begin(), settings_of_it.end(),
                                    [](const core::SettingRow& s) { return s.key == "threads"; });
  auto spec = parse_cell_spec(entrant.engine);
  if (!spec) return spec.error();
  auto settings = core::Settings::parse(spec.value().row->id, spec.value().row->settings, spec.value().settings);
  return settings ? core::Status(core::Done{}) : settings.error();
}

}  // namespace

std::vector<std::string_view> default_entrants() {
  return {kEntrants.begin(), kEntrants.end()};
}

std::vector<std::string> default_scenes() {
  std::vector<std::string> names;
  for (const datasets::SceneRow& row : datasets::scene_table())
    if (row.pattern.starts_with(kFamily)) names.emplace_back(row.example);
  names.insert(names.end(), kHeaps.begin(), kHeaps.end());
  return names;
}

core::Result<std::vector<Entrant>> entrants_of(const ContestRequest& request) {
  std::vector<Entrant> entrants;
  for (const std::string& engine : request.engines) entrants.push_back({engine, "", false});
  if (entrants.empty())
    for (const std::string_view engine : kEntrants) entrants.push_back({std::string(engine), "", false});
  for (Entrant& entrant : entrants)
    if (core::Status s = complete(entrant); !s) return s.error();
  return entrants;
}

core::Result<std::vector<std::string>> scenes_of(const ContestRequest& request) {
  const std::vector<std::string> known = default_scenes();
  if (request.scenes.empty()) {
    std::vector<std::string> all = known;
    if (request.has_largest_heaps) all.emplace_back(kLargestHeap);
    return all;
  }
  std::vector<std::string> names;
  for (std::string wanted : request.scenes) {
    const bool is_beginning = wanted.ends_with(':') || wanted.ends_with('*');
    if (!is_beginning) {
      names.push_back(wanted);
      continue;
    }
    if (wanted.ends_with('*')) wanted.pop_back();
    const std::size_t before = names.size();
    for (const std::string& name : known)
      if (begins_with_one_of(name, {wanted})) names.push_back(name);
    if (names.size() == before)
      return core::Error{"no scene with an answer begins with '" + wanted + "'", "--scenes",
                         "see 'broadside list scenes'"};
  }
  return names;
}

core::Result<std::vector<std::string>> scenes_with_energy(const ContestRequest& request) {
  if (!request.scenes.empty()) return scenes_of(request);
  std::vector<std::string> names(kAtEveryStep.begin(), kAtEveryStep.end());
  names.emplace_back(kHeaps[0]);
  return names;
}

std::string scene_at(const std::string& scene, double dt_s, double factor) {
  return factor == 1.0 ? scene : scene + "@" + step_text(dt_s * factor);
}

core::Result<campaign::CampaignFile> contest_campaign(const ContestRequest& request) {
  auto entrants = entrants_of(request);
  if (!entrants) return entrants.error();
  auto scenes = scenes_of(request);
  if (!scenes) return scenes.error();
  campaign::CampaignFile campaign;
  campaign.name = "contest";
  for (const std::string& name : scenes.value()) {
    auto scene = SceneArguments{name, 0, false}.make();
    if (!scene) return scene.error();
    for (const Entrant& entrant : entrants.value()) {
      if (!entrant.absent.empty()) continue;
      if (entrant.has_threads && std::find(kOfThreads.begin(), kOfThreads.end(), name) != kOfThreads.end())
        for (const char* threads : {"1", "2"}) {
          campaign::CellWork work;
          work.scene = name;
          work.engine = with_threads(entrant.engine, threads);
          work.repetitions = 0;
          work.time_limit_s = request.time_limit_s;
          campaign.cells.push_back(std::move(work));
        }
      for (const double factor : steps_of(request, name, scene.value(), entrant.engine)) {
        campaign::CellWork work;
        work.scene = scene_at(name, static_cast<double>(scene.value().dt_s), factor);
        work.engine = entrant.engine;
        work.repetitions = request.repetitions;
        work.time_limit_s = request.time_limit_s;
        campaign.cells.push_back(std::move(work));
      }
    }
  }
  if (request.scenes.empty()) add_passages(campaign, entrants.value(), request.time_limit_s);
  return campaign;
}

}  // namespace broadside::bench::contest
