// HDF5 box streams: written, read, and refused where they are not sound.
#include "core/trace/box_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "datasets/box_streams/box_stream.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::Box;
using datasets::make_box_stream;
using tests::TemporaryFolder;

core::Status write_boxes(const std::filesystem::path& path, const std::vector<std::vector<Box>>& frames) {
  std::size_t frame = 0;
  return core::write_box_file(path, frames.size(), [&] { return core::Result<std::vector<Box>>(frames[frame++]); });
}

TEST(BoxFile, AStreamComesBackFrameByFrame) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "moving.h5";
  auto made = make_box_stream("boxes:moving:300").value();
  std::vector<std::vector<Box>> frames{made.boxes};
  for (int k = 0; k < 4; ++k) {
    std::vector<Box> boxes = frames.back();
    ASSERT_TRUE(made.advance(boxes).ok());
    frames.push_back(boxes);
  }
  const core::Status written = write_boxes(path, frames);
  ASSERT_TRUE(written.ok()) << written.error().line();
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".part"));

  auto read = make_box_stream(path.string());
  ASSERT_TRUE(read.ok()) << read.error().line();
  ASSERT_EQ(read.value().frames, 5U);
  std::vector<Box> boxes = read.value().boxes;
  EXPECT_EQ(boxes, frames[0]);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    ASSERT_TRUE(read.value().advance(boxes).ok());
    EXPECT_EQ(boxes, frames[k]) << k;
  }
}

TEST(BoxFile, NoBoxesAreBoxesToo) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "none.h5";
  ASSERT_TRUE(write_boxes(path, {{}}).ok());
  const auto read = make_box_stream(path.string());
  ASSERT_TRUE(read.ok()) << read.error().line();
  EXPECT_TRUE(read.value().boxes.empty());
}

TEST(BoxFile, EachBadFileIsOneClearLine) {
  const TemporaryFolder folder;
  const auto line = [](const std::filesystem::path& path) {
    const auto stream = make_box_stream(path.string());
    EXPECT_FALSE(stream.ok()) << path;
    return stream.ok() ? std::string() : stream.error().line();
  };
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Box good{{0, 0, 0}, {1, 1, 1}};
  const auto path = folder.path() / "bad.h5";
  ASSERT_TRUE(write_boxes(path, {{good, {{0, 0, -kInf}, {1, 1, 1}}}}).ok());
  EXPECT_NE(line(path).find("frame 0: box 1: it is NaN or infinite on z"), std::string::npos) << line(path);
  ASSERT_TRUE(write_boxes(path, {{good, {{0, 2, 0}, {1, 1, 1}}}}).ok());
  EXPECT_NE(line(path).find("frame 0: box 1: its min is above its max on y"), std::string::npos);
  EXPECT_NE(line(folder.file("text.h5", "no HDF5")).find("not an HDF5 file"), std::string::npos);
  EXPECT_NE(line(folder.path() / "absent.h5").find("no such file"), std::string::npos);

  // An error in a later frame is found when that frame is reached.
  ASSERT_TRUE(write_boxes(path, {{good}, {{{0, 0, 0}, {kInf, 1, 1}}}}).ok());
  auto stream = make_box_stream(path.string());
  ASSERT_TRUE(stream.ok());
  std::vector<Box> boxes = stream.value().boxes;
  const core::Status status = stream.value().advance(boxes);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("frame 1: box 0: it is NaN or infinite on x"), std::string::npos);
}

TEST(BoxFile, FramesOfDifferentCountsLeaveNoFile) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "uneven.h5";
  const Box good{{0, 0, 0}, {1, 1, 1}};
  const core::Status status = write_boxes(path, {{good}, {good, good}});
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("frame 1 has 2 boxes, not 1"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace broadside
