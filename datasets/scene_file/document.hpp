// A TOML file as a tree of values that keep their line number: the input of the readers of scene files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

struct Node {
  enum class Kind { kTable, kArray, kText, kWhole, kNumber, kFlag, kOther };
  Kind kind = Kind::kOther;
  std::uint32_t line = 0;                             // 1-based
  std::string text;                                   // kText
  std::int64_t whole = 0;                             // kWhole
  double number = 0.0;                                // kNumber, and kWhole converted
  bool flag = false;                                  // kFlag
  std::vector<std::pair<std::string, Node>> members;  // kTable, in order of the keys
  std::vector<Node> items;                            // kArray

  // Defined where Node is complete: if the class defines these, clang 14 instantiates a pair of an incomplete Node.
  Node();
  Node(const Node&);
  Node(Node&&) noexcept;
  Node& operator=(const Node&);
  Node& operator=(Node&&) noexcept;
  ~Node();
};

// Larger files are refused: a body takes about 100 bytes of text, so this holds the ten million bodies that a scene may
// have.
inline constexpr std::uint64_t kMaxSceneFileBytes = std::uint64_t{1} << 30;

// `kind` is what an error calls the file. Errors: missing, not a file, unreadable, too large, names or brackets that
// nest too deeply (toml_nesting.hpp), or not TOML (the last two with file:line).
core::Result<Node> parse_toml(const std::filesystem::path& path, std::string_view kind = "scene file");

}  // namespace broadside::datasets
