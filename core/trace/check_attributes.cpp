#include "core/trace/check_attributes.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace broadside::core {
namespace {

// From the HDF5 File Format Specification, version 2.0: sections II.A to III.A and IV.A.
constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
constexpr std::uint16_t kContinuation = 0x10;
constexpr std::uint16_t kSymbolTable = 0x11;
constexpr std::uint16_t kAttribute = 0x0C;
constexpr std::size_t kMessageHead = 8;
// A group of a trace has tens of objects, and one of our object headers some KiB.
constexpr std::size_t kMostObjects = 100000;
constexpr std::uint64_t kLongestChunk = 16U << 20U;

// Bytes of a type's message, by class (fixed point, floating point, time, string, bit field, opaque, compound,
// reference): 8 and the properties of the class. 0: not known here.
constexpr std::array<std::uint64_t, 8> kTypeBytes{12, 20, 10, 8, 12, 8, 0, 8};

class Bytes {
 public:
  explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] bool starts_with(std::string_view text) const { return std::string_view(bytes_).starts_with(text); }
  // A little-endian number of `count` bytes; 0 past the end, so callers check size() first.
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t count) const {
    std::uint64_t value = 0;
    if (at + count > bytes_.size()) return 0;
    for (std::size_t k = count; k-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes_[at + k]);
    return value;
  }
  [[nodiscard]] Bytes part(std::size_t at, std::size_t count) const { return Bytes(bytes_.substr(at, count)); }

 private:
  std::string bytes_;
};

class Walk {
 public:
  explicit Walk(const std::filesystem::path& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Walk() {
    if (file_ >= 0) ::close(file_);
  }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  Status run() {
    const Bytes head = read(0, 96);
    const std::uint64_t version = head.number(8, 1);
    // On current machines HDF5 writes addresses of no other size.
    if (head.size() < 96 || !head.starts_with(kSignature) || version > 1 || head.number(13, 2) != 0x0808) return Done{};
    to_do_.push_back(head.number(version == 0 ? 64 : 68, 8));
    while (!to_do_.empty()) {
      const std::uint64_t at = to_do_.back();
      to_do_.pop_back();
      if (!seen_.insert(at).second || seen_.size() > kMostObjects) continue;
      if (Status s = check_object(at); !s) return s;
    }
    return Done{};
  }

 private:
  // Reads fewer bytes at the file's end, and none where the file cannot be read, which HDF5 reports later.
  [[nodiscard]] Bytes read(std::uint64_t at, std::size_t count) const {
    std::string bytes(count, '\0');
    if (file_ < 0 || at > static_cast<std::uint64_t>(INT64_MAX)) return Bytes("");
    const ssize_t got = ::pread(file_, bytes.data(), count, static_cast<off_t>(at));
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return Bytes(std::move(bytes));
  }

  [[nodiscard]] Error bad(std::uint64_t at) const {
    return {"an attribute does not fit into its message at byte " + std::to_string(at), path_.string(),
            "the file is damaged: record it again", Exit::kBadInput};
  }

  Status check_object(std::uint64_t at) {
    const Bytes head = read(at, 16);
    if (head.size() < 16 || head.number(0, 1) != 1) return Done{};
    std::vector<std::pair<std::uint64_t, std::uint64_t>> chunks{{at + 16, head.number(8, 4)}};
    std::set<std::uint64_t> known{at + 16};
    for (std::size_t k = 0; k < chunks.size(); ++k) {
      const auto [begin, length] = chunks[k];
      if (length > kLongestChunk) continue;
      const Bytes chunk = read(begin, static_cast<std::size_t>(length));
      for (std::size_t m = 0; m + kMessageHead <= chunk.size();) {
        const std::uint64_t type = chunk.number(m, 2);
        const std::size_t size = static_cast<std::size_t>(chunk.number(m + 2, 2));
        const bool is_shared = (chunk.number(m + 4, 1) & 2U) != 0;
        if (m + kMessageHead + size > chunk.size()) break;
        const Bytes message = chunk.part(m + kMessageHead, size);
        if (type == kContinuation && known.insert(message.number(0, 8)).second)
          chunks.emplace_back(message.number(0, 8), message.number(8, 8));
        if (type == kSymbolTable) visit_tree(message.number(0, 8));
        if (type == kAttribute && !is_shared && !fits(message)) return bad(begin + m);
        m += kMessageHead + size;
      }
    }
    return Done{};
  }

  // Visits the objects of a group: a tree of symbol table nodes.
  void visit_tree(std::uint64_t root) {
    std::vector<std::uint64_t> nodes{root};
    while (!nodes.empty()) {
      const std::uint64_t at = nodes.back();
      nodes.pop_back();
      if (!seen_.insert(at).second || seen_.size() > kMostObjects) continue;
      const Bytes head = read(at, 24);
      const std::size_t count = static_cast<std::size_t>(head.number(6, 2));
      if (head.starts_with("TREE")) {
        const Bytes entries = read(at + 24, 8 + 16 * count);
        for (std::size_t k = 0; k < count && 8 + 16 * k + 8 <= entries.size(); ++k)
          nodes.push_back(entries.number(8 + 16 * k, 8));
      } else if (head.starts_with("SNOD")) {
        const Bytes entries = read(at + 8, 40 * count);
        for (std::size_t k = 0; k < count && 40 * k + 16 <= entries.size(); ++k)
          to_do_.push_back(entries.number(40 * k + 8, 8));
      }
    }
  }

  static bool fits(const Bytes& message) {
    const std::uint64_t version = message.number(0, 1);
    if (message.size() < 8 || version < 1 || version > 3) return false;
    // A trace never has a type or shape that is stored elsewhere.
    if (version > 1 && (message.number(1, 1) & 3U) != 0) return false;
    const auto padded = [version](std::uint64_t n) { return version == 1 ? (n + 7) / 8 * 8 : n; };
    const std::uint64_t type_bytes = message.number(4, 2);
    const std::uint64_t shape_bytes = message.number(6, 2);
    const std::uint64_t type = (version == 3 ? 9 : 8) + padded(message.number(2, 2));
    const std::uint64_t shape = type + padded(type_bytes);
    const std::uint64_t values = shape + padded(shape_bytes);
    if (type_bytes < 8 || shape_bytes < 4 || values > message.size()) return false;
    const std::uint64_t kind = message.number(type, 1) & 15U;
    if (kind < kTypeBytes.size() && type_bytes < kTypeBytes[kind]) return false;
    std::uint64_t bytes = message.number(type + 4, 4);
    return multiply_by_shape(message.part(shape, shape_bytes), bytes) && bytes <= message.size() - values;
  }

  static bool multiply_by_shape(const Bytes& shape, std::uint64_t& bytes) {
    const std::uint64_t version = shape.number(0, 1);
    const std::uint64_t rank = shape.number(1, 1);
    const bool has_limits = (shape.number(2, 1) & 1U) != 0;
    const std::size_t head = version == 1 ? 8 : 4;
    if (version < 1 || version > 2 || shape.size() < head + rank * (has_limits ? 16 : 8)) return false;
    if (version == 2 && shape.number(3, 1) == 2) bytes = 0;  // no values at all
    for (std::uint64_t k = 0; k < rank; ++k)
      if (__builtin_mul_overflow(bytes, shape.number(head + 8 * k, 8), &bytes)) return false;
    return true;
  }

  const std::filesystem::path& path_;
  int file_;
  std::vector<std::uint64_t> to_do_;
  std::set<std::uint64_t> seen_;
};

}  // namespace

Status check_attributes(const std::filesystem::path& path) {
  return Walk(path).run();
}

}  // namespace broadside::core
