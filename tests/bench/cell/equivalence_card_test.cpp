// Every engine of the table says how its world differs from a scene, in the same words as the others.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "bench/cell/equivalence.hpp"
#include "bench/engines.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside {
namespace {

core::Scene scene_of_a_box() {
  core::Scene scene;
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({1.0, 1.0, 1.0}, {1, 1, 1}).value())};
  scene.bodies.resize(1);
  return scene;
}

core::Engine made(const core::EngineRow& row, const std::map<std::string, std::string>& settings = {}) {
  auto engine = row.create(core::Settings::parse(row.id, row.settings, settings).value());
  EXPECT_TRUE(engine.ok()) << row.id;
  return std::move(engine).value();
}

std::map<std::string, core::EquivalenceFact> facts_of(const core::Engine& engine) {
  std::map<std::string, core::EquivalenceFact> facts;
  for (const core::EquivalenceFact& fact : bench::equivalence_of(engine, scene_of_a_box())) {
    EXPECT_FALSE(fact.engine.empty()) << engine.id << " says nothing of " << fact.property;
    EXPECT_TRUE(facts.emplace(fact.property, fact).second) << engine.id << " says twice: " << fact.property;
  }
  return facts;
}

TEST(EquivalenceCard, EveryEngineAnswersTheQuestionsOfItsCapabilities) {
  for (const core::EngineRow& row : bench::engines()) {
    if (!bench::why_absent(row).empty()) continue;
    if (row.create == nullptr) continue;  // a program sends its own card
    const core::Engine engine = made(row);
    std::vector<std::string> asked{"library loaded", "library build", "precision", "SIMD", "threads"};
    const auto ask = [&](const std::vector<std::string>& more) { asked.insert(asked.end(), more.begin(), more.end()); };
    if (engine.broad_phase) ask({"broad-phase margin"});
    if (engine.narrow_phase && !engine.dynamics) ask({"shape margin", "tolerance"});
    if (engine.dynamics)
      ask({"shape margin", "contact margin", "broad-phase margin", "friction rule", "restitution rule",
           "contact solver", "solver iterations", "warm starting", "sleeping"});
    const auto facts = facts_of(engine);
    for (const std::string& property : asked)
      EXPECT_TRUE(facts.contains(property)) << row.id << " says nothing of its " << property;
    EXPECT_NE(facts.at("library loaded").engine.find_first_of("0123456789"), std::string::npos) << row.id;
    EXPECT_EQ(facts.at("library build").engine.find("unknown"), std::string::npos) << row.id;
  }
}

TEST(EquivalenceCard, ThreadsAreThoseThatWereAskedFor) {
  for (const std::string id : {"embree-collide", "exact-mesh", "exact-shapes", "all-pairs", "fcl-mesh", "octree-cpu"}) {
    const core::EngineRow& row = *bench::find_engine(id).value();
    if (!bench::why_absent(row).empty()) continue;
    EXPECT_EQ(facts_of(made(row, {{"threads", "1"}})).at("threads").engine, "1") << id;
  }
}

TEST(EquivalenceCard, AMarginThatTheSceneDoesNotHaveIsMarked) {
  for (const std::string id : {"bullet-dbvt", "bullet-dbvt-tree", "bullet-shapes", "bullet-world"}) {
    const core::EngineRow& row = *bench::find_engine(id).value();
    const std::string property = id.starts_with("bullet-dbvt") ? "broad-phase margin" : "shape margin";
    EXPECT_FALSE(facts_of(made(row, {{"margin", "0"}})).at(property).differs()) << id;
    const core::EquivalenceFact fact = facts_of(made(row, {{"margin", "0.0125"}})).at(property);
    EXPECT_TRUE(fact.differs()) << id;
    EXPECT_NE(fact.engine.find("0.0125 m"), std::string::npos) << fact.engine;
  }
}

}  // namespace
}  // namespace broadside
