// Names, folders and calls that a writer refuses, each with one clear line and nothing left behind.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iostream>

#include "core/trace/trace_reader.hpp"
#include "core/trace/trace_writer.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

TraceHeader small_header(std::uint32_t groups = 0) {
  return header_of(tetrahedra_scene(2), groups);
}

std::string create_line(const std::filesystem::path& path, const TraceHeader& header = small_header()) {
  const auto writer = TraceWriter::create(path, header);
  return writer.ok() ? "" : writer.error().line();
}

void expect_words(const std::string& line, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << word << " is not in: " << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

TEST(Refusal, AFolderThatIsMissingOrNoFolder) {
  const Folder folder;
  expect_words(create_line(folder / "absent/t.h5"), {"absent/t.h5.part", "folder does not exist", "create the folder"});
  std::ofstream(folder / "file") << "x";
  expect_words(create_line(folder / "file/t.h5"), {"file/t.h5.part", "folder does not exist"});
}

TEST(Refusal, AFolderThatMayNotBeWritten) {
  const Folder folder;
  ASSERT_EQ(chmod(folder.path().c_str(), 0555), 0);
  const auto as_nobody = [&folder] {
    if (geteuid() == 0 && seteuid(65534) != 0) _exit(1);
    std::cerr << create_line(folder / "t.h5") << '\n';
    _exit(0);
  };
  EXPECT_EXIT(as_nobody(), testing::ExitedWithCode(0), "t.h5.part: .*no permission to write there.*choose a folder");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Refusal, ANameThatIsAFolder) {
  const Folder folder;
  std::filesystem::create_directory(folder / "t.h5");
  expect_words(create_line(folder / "t.h5"), {"t.h5", "a folder has that name"});
}

TEST(Refusal, ASecondWriterOfTheSameName) {
  const Folder folder;
  auto first = TraceWriter::create(folder / "t.h5", small_header(bit(Group::kPairs)));
  ASSERT_TRUE(first.ok());
  expect_words(create_line(folder / "t.h5"), {"t.h5.part", "another writer", "choose another name"});
  EXPECT_EXIT(
      {
        std::cerr << create_line(folder / "t.h5") << '\n';
        _exit(0);
      },
      testing::ExitedWithCode(0), "another writer");
  FrameRecord frame;
  frame.step = 1;
  frame.pairs = {{0, 1}};
  EXPECT_TRUE(first.value().append(frame).ok());
  EXPECT_TRUE(first.value().finish().ok());
  const auto reader = TraceReader::open(folder / "t.h5");
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader.value().frame_count(), 1U) << "the refused writer spoiled the first one's file";
  EXPECT_EQ(create_line(folder / "t.h5"), "") << "the name is free again";
}

TEST(Refusal, AnOldTraceStaysUntilTheNewOneIsFinished) {
  const Folder folder;
  {
    auto old = TraceWriter::create(folder / "t.h5", small_header());
    FrameRecord frame;
    frame.step = 5;
    ASSERT_TRUE(old.value().append(frame).ok());
    ASSERT_TRUE(old.value().finish().ok());
  }
  auto fresh = TraceWriter::create(folder / "t.h5", small_header());
  ASSERT_TRUE(fresh.ok());
  EXPECT_EQ(TraceReader::open(folder / "t.h5").value().frame_count(), 1U);
  ASSERT_TRUE(fresh.value().finish().ok());
  EXPECT_EQ(TraceReader::open(folder / "t.h5").value().frame_count(), 0U);
}

TEST(Refusal, AHeaderThatCannotBeReadBack) {
  const Folder folder;
  TraceHeader header = small_header();
  header.stamp.scene_digest ^= 1U;
  expect_words(create_line(folder / "t.h5", header), {"scene_digest"});
  header = small_header();
  header.scene.bodies[0].mesh = 7;
  expect_words(create_line(folder / "t.h5", header), {"body 0", "mesh"});
  header = small_header();
  header.every = 0;
  expect_words(create_line(folder / "t.h5", header), {"every is 0"});
  header = small_header();
  header.notes[""] = "x";
  expect_words(create_line(folder / "t.h5", header), {"a note has no name"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Refusal, FramesThatDoNotFitTheHeader) {
  const Folder folder;
  Bits bits(1);
  const auto refused = [&](const auto& spoil) {
    auto writer = TraceWriter::create(folder / "t.h5", small_header(kAllGroups));
    FrameRecord frame;
    do frame = random_frame(bits, 4, 2, kAllGroups);
    while (frame.confirmed.size() < 2 || frame.proximity.empty() || frame.measured.empty());
    EXPECT_TRUE(writer.value().append(frame).ok());
    frame.step = 5;
    spoil(frame);
    const Status s = writer.value().append(frame);
    return s.ok() ? std::string() : s.error().line();
  };
  EXPECT_EQ(refused([](FrameRecord&) {}), "");
  expect_words(refused([](FrameRecord& f) { f.step = 4; }), {"step 4 follows step 4"});
  expect_words(refused([](FrameRecord& f) { f.position.pop_back(); }), {"step 5", "/trace/body/position", "2 bodies"});
  expect_words(refused([](FrameRecord& f) { f.boxes.clear(); }), {"step 5", "/trace/detection/boxes"});
  expect_words(refused([](FrameRecord& f) { f.proximity.pop_back(); }), {"step 5", "one proximity per confirmed pair"});
  expect_words(refused([](FrameRecord& f) { f.separations.pop_back(); }),
               {"step 5", "one separation per measured pair"});
}

}  // namespace
}  // namespace broadside::tests
