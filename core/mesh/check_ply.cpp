#include "core/mesh/check_ply.hpp"

#include <algorithm>
#include <array>
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

struct Type {
  std::string_view name;
  std::size_t bytes;
  bool is_whole;
};

constexpr std::array<Type, 16> kTypes{{{"char", 1, true},
                                       {"uchar", 1, true},
                                       {"int8", 1, true},
                                       {"uint8", 1, true},
                                       {"short", 2, true},
                                       {"ushort", 2, true},
                                       {"int16", 2, true},
                                       {"uint16", 2, true},
                                       {"int", 4, true},
                                       {"uint", 4, true},
                                       {"int32", 4, true},
                                       {"uint32", 4, true},
                                       {"float", 4, false},
                                       {"float32", 4, false},
                                       {"double", 8, false},
                                       {"float64", 8, false}}};

const Type* type_named(std::string_view name) {
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [&](const Type& t) { return t.name == name; });
  return found == kTypes.end() ? nullptr : found;
}

struct Property {
  std::string name;
  const Type* count = nullptr;  // for a list; otherwise null
  const Type* value = nullptr;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { kText, kLittle, kBig };

struct Header {
  Format format = Format::kText;
  std::vector<PlyElement> elements;
  std::size_t body = 0;  // offset of its first byte
};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

class PlyCheck {
 public:
  explicit PlyCheck(const std::filesystem::path& path) : path_(path) {}

  Status run() {
    std::ostringstream content;
    content << std::ifstream(path_, std::ios::binary).rdbuf();
    bytes_ = std::move(content).str();
    if (Status s = read_header(); !s) return s;
    if (Status s = check_elements(); !s) return s;
    return header_.format == Format::kText ? check_text() : check_binary();
  }

 private:
  Error bad(const std::string& what) const {
    return {"not a readable mesh: " + what, path_.string(), "check that the file is whole", Exit::kBadInput};
  }

  Status read_header() {
    std::size_t at = 0;
    for (int number = 1;; ++number) {
      const std::size_t end = bytes_.find('\n', at);
      // A text with more lines than this before its end_header is not a PLY header.
      if (end == std::string::npos || number > 10000) return bad("its header has no end_header");
      const std::vector<std::string> words = words_of(bytes_.substr(at, end - at));
      at = end + 1;
      if (number == 1) {
        if (words != std::vector<std::string>{"ply"}) return bad("it does not begin with 'ply'");
        continue;
      }
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (Status s = read_line(words, number); !s) return s;
    }
    header_.body = at;
    return Done{};
  }

  Status read_line(const std::vector<std::string>& words, int number) {
    const std::string where = "line " + std::to_string(number) + " of its header is not understood";
    if (words[0] == "format" && words.size() == 3) {
      if (words[1] == "ascii")
        header_.format = Format::kText;
      else if (words[1] == "binary_little_endian")
        header_.format = Format::kLittle;
      else if (words[1] == "binary_big_endian")
        header_.format = Format::kBig;
      else
        return bad(where);
      return Done{};
    }
    if (words[0] == "element" && words.size() == 3) {
      PlyElement element{words[1], 0, {}};
      const char* end = words[2].data() + words[2].size();
      const auto [stop, failed] = std::from_chars(words[2].data(), end, element.count);
      if (failed != std::errc() || stop != end) return bad(where);
      header_.elements.push_back(std::move(element));
      return Done{};
    }
    if (words[0] != "property" || header_.elements.empty()) return bad(where);
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) return bad(where);
    const Property property{words.back(), is_list ? type_named(words[2]) : nullptr, type_named(words[is_list ? 3 : 1])};
    if (property.value == nullptr || (is_list && (property.count == nullptr || !property.count->is_whole)))
      return bad(where);
    header_.elements.back().properties.push_back(property);
    return Done{};
  }

  Status check_elements() {
    const auto has = [&](std::string_view element, std::string_view property, bool is_list) {
      for (const PlyElement& e : header_.elements)
        for (const Property& p : e.properties)
          if (e.name == element && p.name == property && (p.count != nullptr) == is_list) return true;
      return false;
    };
    if (!has("vertex", "x", false) || !has("vertex", "y", false) || !has("vertex", "z", false))
      return bad("it has no vertices with x, y and z");
    for (const PlyElement& e : header_.elements)
      for (const Property& p : e.properties)
        if (e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index") &&
            !(p.count != nullptr && p.value->is_whole))
          return bad("its faces are not lists of whole numbers");
    if (!has("face", "vertex_indices", true) && !has("face", "vertex_index", true))
      return Error{"the mesh has no triangles", path_.string(), "give a mesh with at least one triangle"};
    return Done{};
  }

  Status check_text() const {
    std::uint64_t items = 0;
    for (const PlyElement& e : header_.elements)
      if (__builtin_add_overflow(items, e.count, &items)) return cut();
    std::uint64_t lines = 0;
    std::istringstream body(bytes_.substr(header_.body));
    for (std::string line; std::getline(body, line);) lines += words_of(line).empty() ? 0 : 1;
    return lines < items ? Status(cut()) : Status(Done{});
  }

  Status check_binary() const {
    std::size_t at = header_.body;
    for (const PlyElement& element : header_.elements) {
      std::size_t fixed = 0;
      bool has_list = false;
      for (const Property& p : element.properties) {
        fixed += p.count != nullptr ? p.count->bytes : p.value->bytes;
        has_list = has_list || p.count != nullptr;
      }
      // Items without properties take no bytes, so a header may claim any number of them.
      if (fixed == 0 || element.count > (bytes_.size() - at) / fixed) return cut();
      if (!has_list) at += fixed * element.count;
      for (std::uint64_t n = 0; has_list && n < element.count; ++n)
        if (!skip_item(element, at)) return cut();
    }
    return Done{};
  }

  bool skip_item(const PlyElement& element, std::size_t& at) const {
    for (const Property& p : element.properties) {
      const std::size_t first = p.count != nullptr ? p.count->bytes : p.value->bytes;
      if (bytes_.size() - at < first) return false;
      std::uint64_t length = 0;
      if (p.count != nullptr) length = count_at(at, first) * p.value->bytes;
      at += first;
      if (length > bytes_.size() - at) return false;
      at += length;
    }
    return true;
  }

  // A count of 1, 2 or 4 bytes. A negative count reads as a huge one, which no file can hold.
  std::uint64_t count_at(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t place = header_.format == Format::kLittle ? at + size - 1 - k : at + k;
      value = value << 8 | static_cast<unsigned char>(bytes_[place]);
    }
    return value;
  }

  Error cut() const { return bad("its body is shorter than its header says"); }

  const std::filesystem::path& path_;
  std::string bytes_;
  Header header_;
};

}  // namespace

Status check_ply(const std::filesystem::path& path) {
  return PlyCheck(path).run();
}

}  // namespace broadside::core
