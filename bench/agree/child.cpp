#include "bench/agree/child.hpp"

#include <algorithm>
#include <utility>

#include "bench/agree/query_seconds.hpp"
#include "bench/cell/equivalence.hpp"

namespace broadside::bench {
namespace {

// How many pairs one scene holds. A measure call takes a pose for every body of the scene, so scenes are small; scenes
// of meshes are larger, because meshes that take long to load should be loaded seldom.
constexpr std::size_t kPairsPerScene = 64;
constexpr std::size_t kMeshPairsPerScene = 1024;

core::Scene scene_of(const PairSource& source, std::span<const TestPair> pairs) {
  core::Scene scene;
  scene.name = "agree";
  scene.meshes = source.meshes();
  scene.domain = {{-100.0F, -100.0F, -100.0F}, {100.0F, 100.0F, 100.0F}};
  for (const TestPair& p : pairs) {
    for (const auto& [mesh, pose] : {std::pair{p.mesh_a, p.pose_a}, std::pair{p.mesh_b, p.pose_b}}) {
      core::Body body;
      body.mesh = mesh;
      body.position = pose.position;
      body.orientation = pose.orientation;
      scene.bodies.push_back(body);
    }
  }
  return scene;
}

core::Result<core::Engine> make_engine(const CellSpec& cell) {
  auto settings = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
  if (!settings) return settings.error();
  auto engine = cell.row->create(settings.value());
  if (engine.ok() && engine.value().narrow_phase == nullptr)
    return core::Error{"it has no narrow phase", std::string(cell.row->id), "see 'broadside list engines'"};
  return engine;
}

void ask_one(core::NarrowPhase& narrow, core::Pair pair, const std::vector<core::Pose>& poses, PairAnswer& answer) {
  core::Status measured = core::Done{};
  answer.seconds = seconds_of([&] { measured = narrow.measure({&pair, 1}, poses); });
  auto found = narrow.read_back();
  const bool is_answered = measured.ok() && found.ok() && found.value().size() == 1;
  if (is_answered) answer.separation = found.value()[0];
  const std::string what = measured.ok() ? "no answer" : measured.error().what;
  if (!is_answered) what.copy(answer.thrown.data(), answer.thrown.size() - 1);
  answer.asked = is_answered ? Asked::kAnswered : Asked::kThrew;
}

}  // namespace

int ask_pairs(const CellSpec& cell, const PairSource& source, const std::vector<TestPair>& pairs, std::size_t first,
              std::size_t last, std::span<PairAnswer> answers, ChildReport& report) {
  report.begin(first, false);
  auto engine = make_engine(cell);
  if (!engine) return kRefused;
  core::NarrowPhase& narrow = *engine.value().narrow_phase;
  const std::size_t most = source.has_depth() ? kPairsPerScene : kMeshPairsPerScene;
  for (std::size_t k = first; k < last; k += most) {
    const std::size_t count = std::min(most, last - k);
    report.begin(k, false);
    const core::Scene scene = scene_of(source, std::span(pairs).subspan(k, count));
    if (core::Status s = narrow.load(scene); !s) {
      report.say(s.error().line());
      return kRefused;
    }
    std::vector<core::Pose> poses;
    for (const core::Body& body : scene.bodies) poses.push_back({body.position, body.orientation});
    for (std::uint32_t p = 0; p < count; ++p) {
      report.begin(k + p, true);
      ask_one(narrow, {2 * p, 2 * p + 1}, poses, answers[k + p]);
    }
  }
  return kAllAsked;
}

int describe_engine(const CellSpec& cell, const PairSource& source, ChildReport& report) {
  report.begin(0, false);
  auto engine = make_engine(cell);
  if (!engine) {
    report.say(engine.error().line());
    return kRefused;
  }
  std::map<std::string, std::string> notes;
  core::add_notes(equivalence_of(engine.value(), scene_of(source, {})), notes);
  std::string text = engine.value().build + "\n";
  for (const auto& [key, value] : notes) text += key + "\t" + value + "\n";
  report.say(text);
  return kAllAsked;
}

EngineWords engine_words(const std::string& said) {
  EngineWords words;
  words.build = said.substr(0, said.find('\n'));
  for (std::size_t at = words.build.size() + 1; at < said.size();) {
    const std::size_t end = std::min(said.find('\n', at), said.size());
    const std::string line = said.substr(at, end - at);
    const std::size_t tab = line.find('\t');
    if (tab != std::string::npos) words.notes[line.substr(0, tab)] = line.substr(tab + 1);
    at = end + 1;
  }
  return words;
}

}  // namespace broadside::bench
