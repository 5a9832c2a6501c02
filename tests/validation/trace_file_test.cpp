// Judging a file gives the verdicts that judging the same frames in memory gives.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/validation/sound_world.hpp"

namespace broadside::tests {
namespace {

class TraceFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("judge_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  core::TraceReader written(const Recording& recording, const char* name) {
    const auto path = folder_ / name;
    auto writer = core::TraceWriter::create(path, recording.header);
    EXPECT_TRUE(writer.ok()) << (writer.ok() ? "" : writer.error().line());
    for (const FrameRecord& frame : recording.frames) EXPECT_TRUE(writer.value().append(frame).ok());
    EXPECT_TRUE(writer.value().finish().ok());
    auto reader = core::TraceReader::open(path);
    EXPECT_TRUE(reader.ok()) << (reader.ok() ? "" : reader.error().line());
    return std::move(reader).value();
  }

 private:
  std::filesystem::path folder_;
};

void expect_same(const std::vector<core::Verdict>& a, const std::vector<core::Verdict>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(line(a[k]), line(b[k]));
    EXPECT_EQ(a[k].measured, b[k].measured) << a[k].validator;
    EXPECT_EQ(a[k].checked, b[k].checked) << a[k].validator;
  }
}

TEST_F(TraceFile, IsJudgedAsItsFramesAre) {
  const core::TraceReader reader = written(sound(), "sound.h5");
  const auto verdicts = validation::judge(reader, nullptr, {});
  ASSERT_TRUE(verdicts.ok()) << verdicts.error().line();
  expect_same(verdicts.value(), judged(sound()));
}

TEST_F(TraceFile, IsJudgedAgainstAnotherFile) {
  Recording other = sound();
  other.frames[30].velocity[0].x += 1.0F;
  const core::TraceReader subject = written(other, "subject.h5");
  const core::TraceReader baseline = written(sound(), "baseline.h5");
  const auto verdicts = validation::judge(subject, &baseline, {});
  ASSERT_TRUE(verdicts.ok()) << verdicts.error().line();
  expect_same(verdicts.value(), judged(other, &sound()));
  const auto determinism = std::find_if(verdicts.value().begin(), verdicts.value().end(),
                                        [](const core::Verdict& v) { return v.validator == "determinism"; });
  ASSERT_NE(determinism, verdicts.value().end());
  EXPECT_EQ(determinism->outcome, core::Outcome::kFail);
  EXPECT_EQ(determinism->worst.step, 31);
}

}  // namespace
}  // namespace broadside::tests
