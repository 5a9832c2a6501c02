// Every input that a fuzzer was started from, or that once was a finding, is read to its end.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/readers.hpp"

namespace broadside::tests {
namespace {

class Corpus : public testing::TestWithParam<fuzz::Reader> {};

TEST_P(Corpus, IsReadToItsEnd) {
  const std::filesystem::path folder =
      std::filesystem::path(BROADSIDE_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    SCOPED_TRACE(entry.path().string());
    GetParam().read(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    // Cut anywhere, it is read as well.
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 16)
      GetParam().read(reinterpret_cast<const std::uint8_t*>(bytes.data()), size);
    ++count;
  }
  EXPECT_GT(count, 3U) << "inputs in " << folder;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(fuzz::kReaders),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace broadside::tests
