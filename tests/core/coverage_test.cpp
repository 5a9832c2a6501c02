// Coverage: a law counts as applied when it met something to check, and it counts once however often it was judged.
#include "core/coverage.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace broadside::core {
namespace {

Verdict said(const char* law, LawKind kind, Outcome outcome) {
  Verdict v{.validator = law, .outcome = outcome};
  v.kind = kind;
  return v;
}

TEST(Coverage, CountsLawsThatMetSomethingByKind) {
  const std::vector<Verdict> verdicts{said("ballistic", LawKind::kMechanics, Outcome::kPass),
                                      said("momentum", LawKind::kMechanics, Outcome::kFail),
                                      said("turning", LawKind::kMechanics, Outcome::kInconclusive),
                                      said("rest", LawKind::kMechanics, Outcome::kNotApplicable),
                                      said("restitution", LawKind::kMethod, Outcome::kNotApplicable),
                                      said("capacity", LawKind::kTrace, Outcome::kPass)};
  const Coverage coverage = coverage_of(verdicts);
  EXPECT_EQ(coverage.of(LawKind::kMechanics).applied, 3U);
  EXPECT_EQ(coverage.of(LawKind::kMechanics).laws, 4U);
  EXPECT_EQ(coverage.of(LawKind::kMethod).applied, 0U);
  EXPECT_EQ(coverage.applied(), 4U);
  EXPECT_EQ(coverage.laws(), 6U);
  EXPECT_EQ(coverage_text(coverage), "3 of 4 laws of mechanics applied, 0 of 1 of the method, 1 of 1 of the trace");
}

TEST(Coverage, ALawAgainstTwoBaselinesIsOneLaw) {
  const std::vector<Verdict> verdicts{said("determinism", LawKind::kTrace, Outcome::kNotApplicable),
                                      said("determinism", LawKind::kTrace, Outcome::kPass),
                                      said("determinism", LawKind::kTrace, Outcome::kPass)};
  EXPECT_EQ(coverage_of(verdicts).laws(), 1U);
  EXPECT_EQ(coverage_text(coverage_of(verdicts)), "1 of 1 law of the trace applied");
  EXPECT_EQ(coverage_text({}), "no law was asked for");
}

TEST(ProvesMotion, OnlyAPassOnABodyThatMoved) {
  Verdict v = said("ballistic", LawKind::kMechanics, Outcome::kPass);
  EXPECT_FALSE(proves_motion(v));
  v.moved = 1;
  EXPECT_FALSE(proves_motion(v)) << "the law does not tie motion to forces";
  v.ties_motion_to_forces = true;
  EXPECT_TRUE(proves_motion(v));
  v.outcome = Outcome::kFail;
  EXPECT_FALSE(proves_motion(v));
}

}  // namespace
}  // namespace broadside::core
