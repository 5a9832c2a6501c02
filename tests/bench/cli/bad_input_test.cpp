// Bad input: one clear line on stderr, exit code 2, and nothing left behind.
#include <gtest/gtest.h>

#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

struct BadCase {
  std::string name;
  std::vector<std::string> arguments;
  std::string must_say;
};

void PrintTo(const BadCase& c, std::ostream* out) {
  *out << c.name;
}

class BadArguments : public testing::TestWithParam<BadCase> {};

TEST_P(BadArguments, GetOneClearLineAndExitCode2) {
  const Ended ended = run_program(GetParam().arguments);
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().must_say), std::string::npos) << ended.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadArguments,
    testing::Values(
        BadCase{"NoSubcommand", {}, "broadside demo"}, BadCase{"UnknownSubcommand", {"rnu"}, "did you mean 'run'?"},
        BadCase{"LikeNoSubcommand", {"nonsense"}, "'nonsense'; 'broadside --help' shows them"},
        BadCase{"LikeNoEngine",
                {"run", "errata:E3", "--engine", "nonsense"},
                "'nonsense'; 'broadside list engines' shows them"},
        BadCase{"NoSuchBoxesAndNoEngine", {"pairs", "nope"}, "no such boxes"},
        BadCase{"BoxesAndNoEngine", {"pairs", "boxes:uniform:10"}, "no engine was named"},
        BadCase{"UnknownOption", {"--vresion"}, "unknown option '--vresion'; see broadside --help"},
        BadCase{"MissingArgument", {"run"}, "run: SCENE is required; see broadside run --help"},
        BadCase{"DemoOfNoScene", {"demo", "--scene", "frefall:cube:5", "--out", "no-such-demo"}, "freefall"},
        BadCase{"UnknownScene", {"run", "frefall:bunny:50", "--engine", "octree-cpu"}, "freefall"},
        BadCase{"MissingSceneFile", {"run", "no-such.toml", "--engine", "octree-cpu"}, "no-such.toml"},
        BadCase{"UnknownEngine", {"run", "errata:E3", "--engine", "octree-cup"}, "octree-cpu"},
        BadCase{"UnknownSetting", {"run", "errata:E3", "--engine", "octree-cpu", "--set", "level=A"}, "levels"},
        BadCase{"UnknownValue", {"run", "errata:E3", "--engine", "octree-cpu[levels=D]"}, "levels"},
        BadCase{"UnknownVariant",
                {"run", "errata:E3", "--engine", "octree-cpu", "--set", "variant=printed-E33"},
                "printed-E3"},
        BadCase{"UnknownMesh", {"run", "freefall:bunnny:50", "--engine", "octree-cpu"}, "bunny"},
        BadCase{"UnknownSceneOption", {"scene", "tower:cube:5[ofset=0.1]"}, "did you mean 'offset'"},
        BadCase{"BoxesAreNoScene", {"run", "boxes:uniform:10", "--engine", "octree-cpu"}, "broadside pairs"},
        BadCase{"PictureIsNoSvg", {"scene", "errata:E2", "--picture", "x.png"}, ".svg"},
        BadCase{"NoSuchMeshFile", {"mesh", "no-such.ply"}, "no-such.ply"},
        BadCase{"UnknownMeshName", {"mesh", "buny"}, "did you mean 'bunny'"},
        BadCase{"ExportOfNoScene", {"export", "towr:cube:5"}, "tower"},
        BadCase{"ZeroFrames",
                {"run", "errata:E3", "--engine", "octree-cpu", "--frames", "0"},
                "--frames: 0 is not a number above zero"},
        BadCase{"NothingToBeFedBy",
                {"run", "errata:E3", "--engine", "all-pairs", "--record", "digest"},
                "does not simulate: it is fed by all frames"},
        BadCase{"NoSuchTrace", {"check", "no-such.h5"}, "no-such.h5"},
        BadCase{"NoSuchCampaignFile", {"plan", "no-such.toml", "--out", "x"}, "no such campaign file"},
        BadCase{"HistoryOfAFolder", {"history", "/"}, "is a folder, and a history is one file"},
        BadCase{"NoSuchFolder", {"report", "no-such-folder", "--html", "x.html"}, "no-such-folder"},
        BadCase{"NoSuchPart", {"recover", "no-such.h5.part"}, "no-such.h5.part"}),
    [](const auto& instance) { return instance.param.name; });

struct BadScene {
  std::string name;
  std::string toml;
  std::string must_say;
};

void PrintTo(const BadScene& c, std::ostream* out) {
  *out << c.name;
}

std::string with_body(const std::string& body) {
  return "name = \"bad\"\nframes = 2\n[domain]\nmin_m = [-5, -5, -5]\nmax_m = [5, 5, 5]\n"
         "[[mesh]]\nname = \"cube\"\nshape = \"box\"\n[[body]]\n" +
         body;
}

class BadSceneFile : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneFile, GetsOneClearLineExitCode2AndLeavesNothing) {
  const ScratchFolder folder;
  std::ofstream(folder / "bad.toml") << GetParam().toml;
  const Ended ended = run_program(
      {"run", (folder / "bad.toml").string(), "--engine", "octree-cpu", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().must_say), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadSceneFile,
    testing::Values(BadScene{"Malformed", "name = \n", "bad.toml"},
                    BadScene{"UnknownKey", with_body("positon_m = [0, 0, 0]\n"), "position_m"},
                    BadScene{"NanPosition", with_body("position_m = [nan, 0, 0]\n"), "position"},
                    BadScene{"InfinitePosition", with_body("position_m = [0, inf, 0]\n"), "position"},
                    BadScene{"ZeroMass", with_body("position_m = [0, 0, 0]\nmass_kg = 0\n"), "mass"},
                    BadScene{"NegativeMass", with_body("position_m = [0, 0, 0]\nmass_kg = -1\n"), "mass"},
                    BadScene{"WrongType", with_body("position_m = \"here\"\n"), "position"}),
    [](const auto& instance) { return instance.param.name; });

struct BadMesh {
  std::string name;
  std::string file;
  std::string content;  // empty = there is no such file
  std::string must_say;
};

void PrintTo(const BadMesh& c, std::ostream* out) {
  *out << c.name;
}

class BadMeshFile : public testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshFile, GetsOneClearLineWithTheSceneFilesLine) {
  const ScratchFolder folder;
  if (!GetParam().content.empty()) std::ofstream(folder / GetParam().file) << GetParam().content;
  std::ofstream(folder / "scene.toml")
      << "name = \"bad\"\nframes = 2\n[domain]\nmin_m = [-5, -5, -5]\nmax_m = [5, 5, 5]\n"
      << "[[mesh]]\nname = \"m\"\nfile = \"" << GetParam().file << "\"\n[[body]]\nposition_m = [0, 0, 0]\n";
  const Ended ended = run_program(
      {"run", (folder / "scene.toml").string(), "--engine", "octree-cpu", "--out", (folder / "out").string()});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_NE(ended.err.find("scene.toml:8"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().must_say), std::string::npos) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMeshFile,
    testing::Values(BadMesh{"Missing", "no-such.ply", "", "no such mesh file"},
                    BadMesh{"Empty", "empty.obj", "o nothing\n", "empty.obj"},
                    BadMesh{"AllDegenerate", "line.obj", "o a\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "degenerate"},
                    BadMesh{"NanVertex", "nan.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n", "NaN"}),
    [](const auto& instance) { return instance.param.name; });

TEST(BadOutput, UnwritableFolder) {
  const ScratchFolder folder;
  std::ofstream(folder / "a-file") << "in the way";
  const Ended ended =
      run_program({"run", "errata:E3", "--engine", "octree-cpu", "--out", (folder / "a-file" / "out").string()});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_EQ(read_text(folder / "a-file"), "in the way");
}

// HDF5 said "infinite loop closing library" behind our line, when the program ended.
TEST(BadTrace, ADamagedOneIsOneClearLine) {
  const Ended ended =
      run_program({"check", std::string(BROADSIDE_SOURCE_DIR) + "/tests/fuzz/corpus/trace/closed-twice"});
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
}

}  // namespace
}  // namespace broadside::tests
