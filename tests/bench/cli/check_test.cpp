// What `check` prints, and its exit code, when there is little or nothing to judge.
#include <gtest/gtest.h>

#include <string>

#include "core/trace/trace_writer.hpp"
#include "datasets/scenes.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

// A trace of no frame at all, as a writer leaves it that is killed before its first one.
void write_empty(const std::filesystem::path& path) {
  auto scene = datasets::make_scene("two-body:apart");
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  core::TraceHeader header;
  header.scene = std::move(scene).value();
  header.stamp = {
      .scene_name = header.scene.name, .scene_digest = core::scene_digest(header.scene), .engine = "octree-cpu"};
  header.groups = core::bit(core::Group::kBodies);
  auto writer = core::TraceWriter::create(path, header);
  ASSERT_TRUE(writer.ok()) << writer.error().line();
  ASSERT_TRUE(writer.value().finish().ok());
}

std::string record(const ScratchFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run",      "two-body:head-on", "--frames", "60",
                                     "--engine", "octree-cpu",       "--out",    folder / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  return folder / "out" / "octree-cpu.h5";
}

void expect_unjudged(const std::vector<std::string>& arguments) {
  const Ended ended = run_program(arguments);
  EXPECT_EQ(ended.exit_code, 3) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("nothing was judged"), std::string::npos) << ended.out;
}

TEST(Check, OfNoFramesJudgesNothing) {
  const ScratchFolder folder;
  write_empty(folder / "empty.h5");
  expect_unjudged({"check", (folder / "empty.h5").string()});
}

TEST(Check, OfALawThatDoesNotApplyJudgesNothing) {
  const ScratchFolder folder;
  const std::string trace = record(folder);
  expect_unjudged({"check", trace, "--validator", "stability"});
  const Ended judged = run_program({"check", trace, "--validator", "stability", "--validator", "capacity"});
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
  EXPECT_EQ(judged.out.find("nothing was judged"), std::string::npos) << judged.out;
}

// Two runs can be compared by their digests; one alone says nothing.
TEST(Check, OfDigestsAloneNeedsASecondRun) {
  const ScratchFolder folder;
  const std::string trace = record(folder, {"--record", "digest"});
  expect_unjudged({"check", trace});
  EXPECT_EQ(run_program({"check", trace, "--against", trace}).exit_code, 0);
}

TEST(Check, OfAJudgedTraceAndAnUnjudgedOneIsMissing) {
  const ScratchFolder folder;
  const std::string trace = record(folder);
  write_empty(folder / "empty.h5");
  expect_unjudged({"check", trace, (folder / "empty.h5").string()});
}

}  // namespace
}  // namespace broadside::tests
