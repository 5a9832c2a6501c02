#include "core/mesh/check_off.hpp"

#include <charconv>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

// assimp cuts longer lines at this length and reads the rest as the next line.
constexpr std::size_t kLongestLine = 4000;
// assimp drops faces with more corners.
constexpr std::uint64_t kMostCorners = 9;

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\v\f";
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = line.find_first_of(kBlank, at);
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

bool is_keyword(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N", "4"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  return word == "OFF";
}

bool read_whole(std::string_view word, std::uint64_t& value) {
  const auto [stop, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
  return failed == std::errc() && stop == word.data() + word.size();
}

class OffCheck {
 public:
  explicit OffCheck(const std::filesystem::path& path) : path_(path) {}

  Status run() {
    std::ostringstream content;
    content << std::ifstream(path_, std::ios::binary).rdbuf();
    bytes_ = std::move(content).str();
    if (bytes_.find('\0') != std::string::npos) return bad("it is not a text file");
    if (Status s = read_header(); !s) return s;
    for (std::uint64_t v = 0; v < vertices_; ++v) {
      if (!next_line()) return bad("it has " + std::to_string(v) + " of " + std::to_string(vertices_) + " vertices");
      if (words_.size() < 3) return bad("vertex " + std::to_string(v) + " has less than three numbers");
    }
    for (std::uint64_t f = 0; f < faces_; ++f) {
      if (!next_line()) return bad("it has " + std::to_string(f) + " of " + std::to_string(faces_) + " faces");
      if (Status s = check_face(f); !s) return s;
    }
    return Done{};
  }

 private:
  [[nodiscard]] Error bad(const std::string& what) const {
    return {"not a readable mesh: " + what, path_.string(), "check that the file is whole", Exit::kBadInput};
  }

  // The next line that is not empty. False at the end, and at a line that assimp would cut.
  bool next_line() {
    words_.clear();
    while (words_.empty() && at_ < bytes_.size()) {
      std::size_t end = bytes_.find_first_of("\r\n", at_);
      if (end == std::string::npos) end = bytes_.size();
      if (end - at_ > kLongestLine) return false;
      words_ = words_of(std::string_view(bytes_).substr(at_, end - at_));
      at_ = end + 1;
    }
    return !words_.empty();
  }

  // Comment lines may come before the counts; assimp accepts none after them.
  bool next_header_line() {
    do {
      if (!next_line()) return false;
    } while (words_[0].starts_with('#'));
    return true;
  }

  Status read_header() {
    if (!next_header_line() || !is_keyword(words_[0])) return bad("it does not begin with 'OFF'");
    if (words_.size() == 1 && !next_header_line()) return bad("it has no counts");
    const std::size_t first = is_keyword(words_[0]) ? 1 : 0;
    if (words_.size() < first + 3 || !read_whole(words_[first], vertices_) || !read_whole(words_[first + 1], faces_))
      return bad("its counts are not understood");
    return Done{};
  }

  [[nodiscard]] Status check_face(std::uint64_t face) const {
    const std::string where = "face " + std::to_string(face);
    std::uint64_t corners = 0;
    if (!read_whole(words_[0], corners) || corners == 0 || corners > kMostCorners)
      return bad(where + " does not have 1 to 9 corners");
    if (words_.size() < 1 + corners) return bad(where + " is cut short");
    for (std::uint64_t k = 1; k <= corners; ++k) {
      std::uint64_t vertex = 0;
      if (!read_whole(words_[k], vertex) || vertex >= vertices_)
        return bad(where + " names a vertex that does not exist");
    }
    return Done{};
  }

  const std::filesystem::path& path_;
  std::string bytes_;
  std::size_t at_ = 0;
  std::vector<std::string_view> words_;
  std::uint64_t vertices_ = 0;
  std::uint64_t faces_ = 0;
};

}  // namespace

Status check_off(const std::filesystem::path& path) {
  return OffCheck(path).run();
}

}  // namespace broadside::core
