#include "bench/process/kept_hello.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace broadside::bench {
namespace {

namespace fs = std::filesystem;

// A folder that npm installed into, and one with an interpreter, which alone is on PATH.
class KeptHelloTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("kept_hello_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "engine" / "node_modules");
    fs::create_directories(folder_ / "bin");
    write(folder_ / "bin" / "node", "an interpreter");
    write(lock(), "{\"version\": 1}");
    before_ = getenv("PATH");
    setenv("PATH", ("/nowhere:" + (folder_ / "bin").string()).c_str(), 1);
  }
  void TearDown() override {
    setenv("PATH", before_.c_str(), 1);
    fs::remove_all(folder_);
  }
  static void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }
  [[nodiscard]] fs::path lock() const { return folder_ / "engine" / "node_modules" / ".package-lock.json"; }
  [[nodiscard]] KeptHello hello() const { return KeptHello(folder_ / "engine"); }

  fs::path folder_;
  std::string before_;
};

TEST_F(KeptHelloTest, NothingIsKeptBeforeTheFirstAnswer) {
  EXPECT_EQ(hello().answer(), std::nullopt);
}

TEST_F(KeptHelloTest, AnAnswerIsKeptWordForWord) {
  hello().keep("{\n\"id\": \"x\"}\n");
  EXPECT_EQ(hello().answer(), "{\n\"id\": \"x\"}\n");
}

TEST_F(KeptHelloTest, AnotherPackageIsAskedAgain) {
  hello().keep("{}");
  write(lock(), "{\"version\": 2}");
  EXPECT_EQ(hello().answer(), std::nullopt);
}

TEST_F(KeptHelloTest, AnotherInterpreterIsAskedAgain) {
  hello().keep("{}");
  write(folder_ / "bin" / "node", "a newer interpreter");
  EXPECT_EQ(hello().answer(), std::nullopt);
}

TEST_F(KeptHelloTest, WithoutAnInterpreterNothingIsKept) {
  fs::remove(folder_ / "bin" / "node");
  hello().keep("{}");
  EXPECT_EQ(hello().answer(), std::nullopt);
  EXPECT_TRUE(fs::is_empty(folder_ / "bin"));
}

TEST_F(KeptHelloTest, AnAnswerThatWasCutOffBeforeItsStampEndsDoesNotCount) {
  hello().keep("{}");
  fs::resize_file(folder_ / "engine" / "hello.txt", 20);
  EXPECT_EQ(hello().answer(), std::nullopt);
}

}  // namespace
}  // namespace broadside::bench
