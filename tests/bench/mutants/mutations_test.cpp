// Every tampering of the catalogue is rejected, also on a recording from another source: here a world that shares no
// code with the engines. A validator that cannot fail is a defect.
#include <set>
#include <span>
#include <string>

#include "bench/mutants/rigid_tamperings.hpp"
#include "bench/mutants/tamperings.hpp"
#include "reference/mutants/mutants.hpp"
#include "reference/rigid_mutants/rigid_mutants.hpp"
#include "tests/validation/sound_world.hpp"

namespace broadside::tests {
namespace {

std::vector<bench::Tampering> all_tamperings() {
  std::vector<bench::Tampering> all;
  for (const auto part :
       {bench::pair_tamperings(), bench::contact_tamperings(), bench::velocity_tamperings(), bench::state_tamperings()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

TEST(Mutations, EachSpoiledTraceIsRejectedByItsValidator) {
  for (const bench::Tampering& t : all_tamperings()) {
    Recording wrong = sound();
    t.apply(wrong);
    EXPECT_TRUE(wrong.is_spoilable) << t.what;
    const core::Verdict v = verdict_of(std::string(t.validator), wrong, t.against_the_sound_one ? &sound() : nullptr);
    EXPECT_EQ(v.outcome, core::Outcome::kFail) << t.what << ": " << line(v);
    EXPECT_GT(v.violations, 0u) << t.what;
  }
}

TEST(Mutations, EveryValidatorHasSomethingThatItMustReject) {
  std::set<std::string_view> meant;
  for (const bench::Tampering& t : all_tamperings()) meant.insert(t.validator);
  for (const auto part : {reference::pair_mutants(), reference::octree_mutants(), reference::contact_mutants(),
                          reference::velocity_mutants(), reference::state_mutants()})
    for (const reference::Mutant& m : part) meant.insert(m.validator);
  for (const auto part : {reference::flight_mutants(), reference::touch_mutants(), reference::impulse_mutants(),
                          reference::telling_mutants(), reference::pipeline_mutants(), reference::rest_mutants()})
    for (const reference::RigidMutant& m : part) meant.insert(m.law);
  for (const auto part :
       {bench::rigid_state_tamperings(), bench::rigid_point_tamperings(), bench::rigid_declaration_tamperings()})
    for (const bench::RigidTampering& t : part) meant.insert(t.law);
  for (const validation::ValidatorRow& row : validation::validators())
    EXPECT_TRUE(meant.contains(row.name)) << row.name;
}

}  // namespace
}  // namespace broadside::tests
