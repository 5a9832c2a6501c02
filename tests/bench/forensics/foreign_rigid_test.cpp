// The example of a trace of bodies that turn, written in Python: judged by the laws of mechanics, caught where it is
// wrong, and refused in one line where it cannot be read.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "tests/bench/cli/program.hpp"
#include "tests/bench/forensics/python_with_h5py.hpp"

namespace broadside::tests {
namespace {

class ForeignRigid : public testing::Test {
 protected:
  void SetUp() override {
    python_ = python_with_h5py();
    if (python_.empty()) GTEST_SKIP() << "no Python with h5py and numpy here (Debian: python3-h5py)";
  }
  Ended checked(const std::string& fault) const {
    const std::string file = (folder_ / (fault + ".h5")).string();
    const std::string command = python_ + " -B '" + std::string(BROADSIDE_SOURCE_DIR) +
                                "/core/trace/examples/foreign_rigid.py' '" + file + "' --fault " + fault;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return run_program({"check", file});
  }

  std::string python_;
  const ScratchFolder folder_;
};

TEST_F(ForeignRigid, KeepsEveryLawThatItsGroupsAllow) {
  const Ended ended = checked("none");
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  for (const char* law : {"state-sanity", "ballistic", "turning", "gyroscopic", "momentum", "angular-momentum",
                          "friction-cone", "unilateral", "contact-truth", "energy-growth", "box-contains"}) {
    const auto at = ended.out.find("\n" + std::string(law) + " ");
    ASSERT_NE(at, std::string::npos) << law << ended.out;
    EXPECT_NE(ended.out.substr(at, 40).find(" pass"), std::string::npos) << ended.out.substr(at, 80);
  }
}

TEST_F(ForeignRigid, IsCaughtByTheLawMeantForIt) {
  const std::map<std::string, std::string> caught_by{{"gravity", "ballistic"},
                                                     {"half-spin", "turning"},
                                                     {"stale-box", "box-contains"},
                                                     {"nan-impulse", "momentum"},
                                                     {"far-points", "angular-momentum"}};
  for (const auto& [fault, law] : caught_by) {
    const Ended ended = checked(fault);
    EXPECT_EQ(ended.exit_code, 1) << fault << ended.out << ended.err;
    EXPECT_NE(ended.out.find("foreign-brick: " + law + " FAIL"), std::string::npos) << fault << ended.out;
  }
}

TEST_F(ForeignRigid, IsRefusedWhereItCannotBeRead) {
  const std::map<std::string, std::string> words{
      {"no-body", "/trace/point: step 123 names a body that the scene does not have"},
      {"unknown-word", "/declaration: 'friction' cannot be declared as 'con'; did you mean 'cone'?"},
      {"unknown-key", "/declaration: a declaration has no key 'frictoin'; did you mean 'friction'?"},
      {"negative-inertia", "inertia_kg_m2 has a principal moment of zero or below"},
      {"flat-inertia", "inertia_kg_m2 breaks the triangle inequality"},
      {"mixed-precision", "/trace/body/velocity: its elements are not f64"},
      {"wide-boxes", "/trace/detection/boxes: its elements are not f32"}};
  for (const auto& [fault, said] : words) {
    const Ended ended = checked(fault);
    EXPECT_EQ(ended.exit_code, 2) << fault << ended.out;
    EXPECT_TRUE(is_one_line(ended.err)) << fault << ": " << ended.err;
    EXPECT_NE(ended.err.find(said), std::string::npos) << fault << ": " << ended.err;
  }
}

}  // namespace
}  // namespace broadside::tests
