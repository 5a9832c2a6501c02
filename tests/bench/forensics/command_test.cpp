// diff, replay and shrink as a user runs them.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

class Forensics : public testing::Test {
 protected:
  // A trace of this engine on the scene; its path.
  std::string recorded(const std::string& scene, const std::string& engine, const std::string& frames,
                       const std::string& folder, const std::vector<std::string>& more = {}) const {
    const std::string out = (folder_ / folder).string();
    std::vector<std::string> run{"run", scene, "--engine", engine, "--frames", frames, "--out", out};
    run.insert(run.end(), more.begin(), more.end());
    const Ended ended = run_program(run);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    for (const auto& entry : std::filesystem::directory_iterator(out))
      if (entry.path().extension() == ".h5") return entry.path().string();
    return "";
  }

  const ScratchFolder folder_;
};

TEST_F(Forensics, DiffOfARepeatedRunIsNothing) {
  const std::string a = recorded("errata:E6", "octree-cpu[threads=1]", "20", "a");
  const std::string b = recorded("errata:E6", "octree-cpu", "20", "b");
  const Ended ended = run_program({"diff", a, b});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("no difference"), std::string::npos) << ended.out;
}

TEST_F(Forensics, DiffNamesTheFirstContactOfAWrongEngine) {
  const std::string a = recorded("errata:E6", "octree-cpu", "20", "a");
  const std::string b = recorded("errata:E6", "octree-cpu[variant=printed-E6]", "20", "b");
  const Ended text = run_program({"diff", a, b});
  EXPECT_EQ(text.exit_code, 1) << text.err;
  EXPECT_NE(text.out.find("/trace/contact/tangent_impulse"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("Contacts of"), std::string::npos) << text.out;
  const Ended json = run_program({"diff", a, b, "--json"});
  EXPECT_EQ(json.exit_code, 1);
  EXPECT_NE(json.out.find("\"field\": \"/trace/contact/tangent_impulse\""), std::string::npos) << json.out;
}

TEST_F(Forensics, DiffOfOtherScenesAndFilesIsRefused) {
  const std::string a = recorded("errata:E6", "octree-cpu", "2", "a");
  const Ended other = run_program({"diff", a, recorded("errata:E5", "octree-cpu", "2", "b")});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(is_one_line(other.err)) << other.err;
  EXPECT_NE(other.err.find("different scenes"), std::string::npos) << other.err;
  const Ended missing = run_program({"diff", a, (folder_ / "none.h5").string()});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(is_one_line(missing.err)) << missing.err;
}

TEST_F(Forensics, ReplayRepeatsOwnTracesBitByBit) {
  const std::string a = recorded("errata:E6", "octree-cpu", "20", "a");
  const Ended same = run_program({"replay", a, "--engine", "octree-cpu", "--set", "threads=1"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  const Ended wrong = run_program({"replay", a, "--engine", "octree-cpu[variant=printed-E6]"});
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
  EXPECT_NE(wrong.out.find("First difference"), std::string::npos) << wrong.out;
}

// The replay recorded every step, so groups that depend on which steps are recorded were reported as "only in A".
TEST_F(Forensics, ReplayRecordsTheStepsOfTheTrace) {
  const std::string second = recorded("freefall:sphere:10", "octree-cpu", "20", "a", {"--every", "2"});
  const std::string window = recorded("freefall:sphere:10", "octree-cpu", "20", "b", {"--window", "5:9"});
  const std::string both =
      recorded("freefall:sphere:10", "octree-cpu", "20", "c", {"--every", "3", "--window", "2:7", "--window", "9:12"});
  for (const std::string& trace : {second, window, both}) {
    const Ended same = run_program({"replay", trace, "--engine", "octree-cpu"});
    EXPECT_EQ(same.exit_code, 0) << trace << "\n" << same.out << same.err;
    EXPECT_EQ(same.out.find("nly in "), std::string::npos) << same.out;
  }
}

// Bullet looks for contacts before it moves the bodies. Earlier, that alone made every replay differ in step 1, by g
// dt^2.
TEST_F(Forensics, ReplayOfBulletsTraceComparesFlightsAndSaysWhatItLeavesOut) {
  const std::string bullet = recorded("freefall:cube:8", "bullet-world", "90", "a");
  const Ended by_us = run_program({"replay", bullet, "--engine", "octree-cpu"});
  EXPECT_EQ(by_us.exit_code, 0) << by_us.out << by_us.err;
  EXPECT_NE(by_us.out.find("bullet-world looks for contacts before it moves the bodies, octree-cpu after"),
            std::string::npos)
      << by_us.out;
  EXPECT_NE(by_us.out.find("8 of 8 bodies were touched"), std::string::npos) << by_us.out;
  const std::string ours = recorded("freefall:cube:8", "octree-cpu", "90", "b");
  const Ended by_bullet = run_program({"replay", ours, "--engine", "bullet-world"});
  EXPECT_EQ(by_bullet.exit_code, 0) << by_bullet.out << by_bullet.err;
  const Ended same = run_program({"replay", bullet, "--engine", "bullet-world"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
}

TEST_F(Forensics, ReplayOfDigestsComparesDigests) {
  const std::string out = (folder_ / "digests").string();
  ASSERT_EQ(run_program({"run", "errata:E6", "--engine", "octree-cpu", "--record", "digest", "--out", out}).exit_code,
            0);
  const Ended same = run_program({"replay", out + "/octree-cpu.h5", "--engine", "octree-cpu"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  const Ended wrong = run_program({"replay", out + "/octree-cpu.h5", "--engine", "octree-cpu[variant=printed-E6]"});
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out << wrong.err;
}

TEST_F(Forensics, ReplayOfMeasuredSeparationsAgrees) {
  const std::string out = (folder_ / "narrow").string();
  ASSERT_EQ(run_program({"run", "errata:E6", "--frames", "30", "--engine", "exact-mesh", "--out", out}).exit_code, 0);
  const Ended ended = run_program({"replay", out + "/exact-mesh.h5", "--engine", "fcl-mesh"});
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
}

TEST_F(Forensics, ShrinkWritesASceneThatShowsTheFault) {
  const std::string out = (folder_ / "small").string();
  const Ended shrunk = run_program({"shrink", "errata:E6", "--validator", "friction-energy", "--engine",
                                    "octree-cpu[variant=printed-E6]", "--out", out});
  ASSERT_EQ(shrunk.exit_code, 0) << shrunk.out << shrunk.err;
  EXPECT_NE(shrunk.out.find("1 frames"), std::string::npos) << shrunk.out;
  const std::string runs = (folder_ / "runs").string();
  ASSERT_EQ(run_program({"run", out + ".toml", "--engine", "octree-cpu[variant=printed-E6]", "--engine", "octree-cpu",
                         "--out", runs})
                .exit_code,
            0);
  const Ended wrong =
      run_program({"check", runs + "/octree-cpu+variant=printed-E6.h5", "--validator", "friction-energy"});
  EXPECT_EQ(wrong.exit_code, 1) << wrong.out;
  // In the reduced scene a sound engine may have nothing to judge, but must show no fault.
  const Ended sound = run_program({"check", runs + "/octree-cpu.h5", "--validator", "friction-energy"});
  EXPECT_NE(sound.exit_code, 1) << sound.out;
  const std::string source = read_text(out + "_test.cpp");
  EXPECT_NE(source.find("TEST(Shrunk, FrictionEnergyHolds)"), std::string::npos) << source;
}

TEST_F(Forensics, ShrinkStartsFromTheTraceThatShowsTheFault) {
  const std::string trace = recorded("errata:E3", "octree-cpu[variant=printed-E3]", "30", "a");
  const Ended shrunk = run_program({"shrink", trace, "--validator", "center-of-mass", "--engine",
                                    "octree-cpu[variant=printed-E3]", "--out", (folder_ / "small").string()});
  EXPECT_EQ(shrunk.exit_code, 0) << shrunk.out << shrunk.err;
}

TEST_F(Forensics, ShrinkOfBoxesLeavesALostPair) {
  const std::string out = (folder_ / "pair").string();
  const Ended shrunk =
      run_program({"shrink", "boxes:uniform:300", "--engine", "octree-cpu[variant=printed-E2]", "--out", out});
  ASSERT_EQ(shrunk.exit_code, 0) << shrunk.out << shrunk.err;
  EXPECT_NE(shrunk.out.find("missed: 0 and 1"), std::string::npos) << shrunk.out;
  const Ended raced =
      run_program({"pairs", out + ".boxes", "--engine", "all-pairs", "--engine", "octree-cpu[variant=printed-E2]"});
  EXPECT_EQ(raced.exit_code, 1) << raced.out << raced.err;
}

// Earlier, --out DIR wrote DIR.boxes beside the folder.
TEST_F(Forensics, ShrinkWritesIntoAFolderThatIsThere) {
  std::filesystem::create_directory(folder_ / "place");
  const Ended shrunk = run_program({"shrink", "boxes:uniform:300", "--engine", "octree-cpu[variant=printed-E2]",
                                    "--out", (folder_ / "place").string()});
  ASSERT_EQ(shrunk.exit_code, 0) << shrunk.out << shrunk.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "place" / "shrunk.boxes")) << shrunk.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "place.boxes"));
}

// bullet-dbvt runs in a child process, fed by octree-cpu.
TEST_F(Forensics, ShrinkOfARightEngineSaysSo) {
  for (const char* engine : {"octree-cpu", "bullet-dbvt"}) {
    const Ended ended = run_program({"shrink", "randommove:cube:10", "--frames", "3", "--validator", "candidate-set",
                                     "--engine", engine, "--out", (folder_ / "none").string()});
    EXPECT_EQ(ended.exit_code, 2) << engine << ended.out;
    EXPECT_NE(ended.err.find("nothing to shrink"), std::string::npos) << engine << ended.err;
  }
}

TEST_F(Forensics, ShrinkRefusesBadUsageInOneLine) {
  const std::vector<std::vector<std::string>> wrong{
      {"shrink", "errata:E6", "--engine", "octree-cpu"},
      {"shrink", "errata:E6", "--engine", "octree-cpu", "--validator", "friction"},
      {"shrink", "errata:E6", "--engine", "octree-cpu", "--engine", "all-pairs", "--validator", "capacity"},
      {"shrink", "boxes:uniform:10", "--engine", "exact-mesh"},
      {"replay", "none.h5", "--engine", "octree-cpu"},
  };
  for (const auto& arguments : wrong) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
}

}  // namespace
}  // namespace broadside::tests
