// Every input that a fuzzer was started from, or that once was a finding, is read to its end; so are copies with simple
// damage, which needs no fuzzing compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
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

// HDF5 1.10 reads past the end of such attributes, and without a sanitizer nothing shows. Found by fuzzing within half
// a minute.
TEST(Attributes, ThatDoNotFitAreRefusedBeforeHdf5ReadsThem) {
  const std::filesystem::path folder = std::filesystem::path(BROADSIDE_SOURCE_DIR) / "tests/fuzz/corpus/trace";
  for (const char* name : {"attribute-1f267a9a", "attribute-35697804", "attribute-95e294d5"}) {
    const auto trace = core::TraceReader::open(folder / name);
    ASSERT_FALSE(trace.ok()) << name;
    EXPECT_NE(trace.error().line().find("does not fit into its message"), std::string::npos) << trace.error().line();
  }
  for (const char* name : {"old-narrow", "old-states", "old-zipped", "new-contacts"})
    EXPECT_TRUE(core::TraceReader::open(folder / name).ok()) << name;
}

// Bytes changed, taken out, doubled, and swapped for numbers that lengths and offsets are sensitive to.
void damage(std::vector<char>& bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  constexpr std::array<unsigned char, 6> kEdges{0x00, 0x01, 0x7F, 0x80, 0xFE, 0xFF};
  for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
    const std::size_t at = below(bytes.size());
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto length = static_cast<std::ptrdiff_t>(std::min(bytes.size() - at, 1 + below(16)));
    switch (random() % 5) {
      case 0:
        *place = static_cast<char>(*place ^ (1U << below(8)));
        break;
      case 1:
        *place = static_cast<char>(kEdges[below(kEdges.size())]);
        break;
      case 2:
        std::fill(place, place + length, static_cast<char>(kEdges[below(kEdges.size())]));
        break;
      case 3:
        bytes.erase(place, place + length);
        break;
      default: {
        const std::vector<char> again(place, place + length);
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size())), again.begin(), again.end());
      }
    }
  }
}

// BROADSIDE_FUZZ_SEED and BROADSIDE_FUZZ_RUNS (per input) ask for another run or a longer one. If the process dies, the
// seed tells which damaged input it had read.
TEST_P(Corpus, LivesThroughDamage) {
  const auto asked = [](const char* name, unsigned usual) {
    const char* text = std::getenv(name);
    return text == nullptr ? usual : static_cast<unsigned>(std::strtoul(text, nullptr, 10));
  };
  const unsigned seed = asked("BROADSIDE_FUZZ_SEED", 1);
  const unsigned runs = asked("BROADSIDE_FUZZ_RUNS", 40);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(BROADSIDE_SOURCE_DIR) /
                                                               "tests/fuzz/corpus" / GetParam().name))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::mt19937 random(seed);
  for (const std::filesystem::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> whole{std::istreambuf_iterator<char>(in), {}};
    for (unsigned k = 0; k < runs; ++k) {
      std::vector<char> bytes = whole;
      damage(bytes, random);
      GetParam().read(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(fuzz::kReaders),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace broadside::tests
