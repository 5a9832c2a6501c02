// A kill between any two pages of a flush leaves the old content or the new.
#include "core/trace/page_journal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <string>

#include "core/trace/part_file.hpp"
#include "core/whole_file.hpp"
#include "tests/core/trace/random_frames.hpp"

namespace broadside::tests {
namespace {

using namespace core;

constexpr std::size_t kOldBytes = 5 * kPageBytes + 100;
constexpr std::size_t kNewBytes = 6 * kPageBytes + 7;

std::string bytes_of(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::string bytes(count, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  return bytes;
}

std::string read(const std::filesystem::path& path) {
  return read_whole_file(path).value();
}

void write(PartFile& part, std::uint64_t address, const std::string& bytes) {
  part.write_at(address, reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
}

struct Flush {
  std::string old_content = bytes_of(kOldBytes, 1);
  std::string new_content = old_content + bytes_of(kNewBytes - kOldBytes, 2);
  Pages pages;

  Flush() {
    // One write over two pages, one within a page, and the page in which the old content ended.
    new_content.replace(kPageBytes - 10, 20, bytes_of(20, 3));
    new_content.replace(3 * kPageBytes + 5, 8, bytes_of(8, 4));
    for (const std::uint64_t index : {0U, 1U, 3U, 5U})
      std::memcpy(pages[index].data(), new_content.data() + index * kPageBytes, kPageBytes);
  }
  // The file as a kill leaves it once the journal is there and this many pages are in place.
  void leave(const std::filesystem::path& path, std::size_t pages_in_place) const {
    // Bytes behind the old content's last page go to disk at once.
    std::string left = old_content;
    left.resize(kNewBytes);
    left.replace(6 * kPageBytes, 7, new_content.substr(6 * kPageBytes));
    ASSERT_TRUE(write_whole_file(path, left).ok());
    const int fd = open(path.c_str(), O_RDWR);
    ASSERT_EQ(append_journal(fd, kNewBytes, kNewBytes, pages), 0);
    auto page = pages.begin();
    for (std::size_t k = 0; k < pages_in_place; ++k, ++page)
      ASSERT_EQ(write_fully(fd, page->first * kPageBytes, page->second.data(), kPageBytes), 0);
    close(fd);
  }
};

TEST(PageJournal, FinishesWhatAKillLeftAfterAnyNumberOfPages) {
  const Folder folder;
  const Flush flush;
  for (std::size_t in_place = 0; in_place <= flush.pages.size(); ++in_place) {
    flush.leave(folder / "t.part", in_place);
    ASSERT_TRUE(finish_from_journal(folder / "t.part").ok());
    EXPECT_EQ(read(folder / "t.part"), flush.new_content) << in_place << " pages were in place";
  }
}

TEST(PageJournal, OneThatWasCutOffOrSpoiledIsIgnored) {
  const Folder folder;
  const Flush flush;
  flush.leave(folder / "whole.part", 0);
  const std::string whole = read(folder / "whole.part");
  for (std::size_t keep = kNewBytes; keep < whole.size(); keep += 509) {
    const std::string cut = whole.substr(0, keep);
    ASSERT_TRUE(write_whole_file(folder / "cut.part", cut).ok());
    ASSERT_TRUE(finish_from_journal(folder / "cut.part").ok());
    EXPECT_EQ(read(folder / "cut.part"), cut);
  }
  for (std::size_t at = kNewBytes; at < whole.size(); at += 1021) {
    std::string spoiled = whole;
    spoiled[at] = static_cast<char>(spoiled[at] ^ 4);
    ASSERT_TRUE(write_whole_file(folder / "spoiled.part", spoiled).ok());
    ASSERT_TRUE(finish_from_journal(folder / "spoiled.part").ok());
    EXPECT_EQ(read(folder / "spoiled.part"), spoiled) << "byte " << at;
  }
}

TEST(PartFile, LeavesWhatWasCommittedAloneUntilTheNextCommit) {
  const Folder folder;
  const Flush flush;
  auto part = PartFile::create(folder / "t.part");
  ASSERT_TRUE(part.ok());
  PartFile& file = *part.value();
  write(file, 0, flush.old_content);
  ASSERT_TRUE(file.commit());
  write(file, kPageBytes - 10, flush.new_content.substr(kPageBytes - 10, 20));
  write(file, 3 * kPageBytes + 5, flush.new_content.substr(3 * kPageBytes + 5, 8));
  write(file, kOldBytes, flush.new_content.substr(kOldBytes));
  EXPECT_EQ(read(folder / "t.part").substr(0, kOldBytes), flush.old_content);
  std::string seen(kNewBytes, '\0');
  ASSERT_TRUE(file.read_at(0, reinterpret_cast<std::byte*>(seen.data()), seen.size()));
  EXPECT_EQ(seen, flush.new_content) << "HDF5 must read what it wrote";
  ASSERT_TRUE(file.commit());
  EXPECT_EQ(read(folder / "t.part"), flush.new_content);
}

// How many bytes the file has at most while a commit writes: those of a journal lie behind the content.
std::size_t committed_with(PartFile& file, const std::filesystem::path& path, std::size_t limit_bytes) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = limit_bytes;
  setrlimit(RLIMIT_FSIZE, &small);
  const bool was_enough = file.commit();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  return was_enough ? read(path).size() : 0;
}

// Two pages cannot be written as one, so a kill between the two writes needs the journal: without room for a journal
// there is no commit. A single page needs none.
TEST(PartFile, TwoPagesAreJournalledAndOneIsNot) {
  for (const std::size_t pages : {1U, 2U, 3U}) {
    const Folder folder;
    const Flush flush;
    auto part = PartFile::create(folder / "t.part");
    ASSERT_TRUE(part.ok());
    PartFile& file = *part.value();
    write(file, 0, flush.old_content);
    ASSERT_TRUE(file.commit());
    for (std::size_t k = 0; k < pages; ++k) write(file, k * kPageBytes, "changed");
    EXPECT_EQ(committed_with(file, folder / "t.part", kOldBytes) > 0, pages == 1) << pages << " pages";
  }
}

TEST(PartFile, RollsBackToTheLastCommit) {
  const Folder folder;
  const Flush flush;
  auto part = PartFile::create(folder / "t.part");
  ASSERT_TRUE(part.ok());
  PartFile& file = *part.value();
  write(file, 0, flush.old_content);
  ASSERT_TRUE(file.commit());
  write(file, 0, flush.new_content);
  file.rollback();
  EXPECT_EQ(file.size(), kOldBytes);
  EXPECT_EQ(read(folder / "t.part"), flush.old_content);
}

}  // namespace
}  // namespace broadside::tests
