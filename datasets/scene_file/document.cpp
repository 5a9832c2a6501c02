#include "datasets/scene_file/document.hpp"

#include <toml++/toml.h>

#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "datasets/scene_file/toml_nesting.hpp"

namespace broadside::datasets {
namespace {

using core::Error;
using core::Result;

Node converted(const toml::node& from) {
  Node node;
  node.line = from.source().begin.line;
  if (const toml::table* table = from.as_table()) {
    node.kind = Node::Kind::kTable;
    for (const auto& [key, value] : *table) node.members.emplace_back(std::string(key.str()), converted(value));
  } else if (const toml::array* array = from.as_array()) {
    node.kind = Node::Kind::kArray;
    for (const toml::node& item : *array) node.items.push_back(converted(item));
  } else if (const auto* text = from.as_string()) {
    node.kind = Node::Kind::kText;
    node.text = text->get();
  } else if (const auto* whole = from.as_integer()) {
    node.kind = Node::Kind::kWhole;
    node.whole = whole->get();
    node.number = static_cast<double>(node.whole);
  } else if (const auto* number = from.as_floating_point()) {
    node.kind = Node::Kind::kNumber;
    node.number = number->get();
  } else if (const auto* flag = from.as_boolean()) {
    node.kind = Node::Kind::kFlag;
    node.flag = flag->get();
  }
  return node;
}

Result<std::string> content_of(const std::filesystem::path& path, std::string_view kind) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (status.type() == std::filesystem::file_type::not_found)
    return Error{"no such " + std::string(kind), path.string(), "check the path"};
  if (status.type() != std::filesystem::file_type::regular)
    return Error{"not a file", path.string(), "give a " + std::string(kind)};
  const auto size = std::filesystem::file_size(path, failed);
  if (!failed && size > kMaxSceneFileBytes)
    return Error{"the file is larger than 1024 MiB, the most that is read", path.string(), "use a generator"};
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  // An empty file sets failbit on the copy; only a file that was not opened or broke off is an error.
  if (!file.is_open() || file.bad()) return Error{"cannot be read", path.string(), "check its permissions"};
  return std::move(content).str();
}

core::Status check_nesting(std::string_view text, const std::filesystem::path& path) {
  const TomlNesting nesting = toml_nesting(text);
  if (nesting.line == 0) return core::Done{};
  const bool is_name = nesting.name_parts > kMostNameParts;
  return Error{std::string(is_name ? "a name has more than " : "brackets nest more than ") +
                   std::to_string(is_name ? kMostNameParts : kDeepestToml) +
                   (is_name ? " parts, the most that are read" : " levels deep, the most that are read"),
               path.string() + ":" + std::to_string(nesting.line), "check that it is a file for this program"};
}

}  // namespace

Node::Node() = default;
Node::Node(const Node&) = default;
Node::Node(Node&&) noexcept = default;
Node& Node::operator=(const Node&) = default;
Node& Node::operator=(Node&&) noexcept = default;
Node::~Node() = default;

Result<Node> parse_toml(const std::filesystem::path& path, std::string_view kind) {
  const Result<std::string> content = content_of(path, kind);
  if (!content) return content.error();
  if (core::Status s = check_nesting(content.value(), path); !s) return s.error();
  try {
    return converted(toml::parse(std::string_view(content.value()), path.string()));
  } catch (const toml::parse_error& e) {
    std::string what(e.description());
    for (char& c : what)
      if (c == '\n') c = ' ';
    return Error{what, path.string() + ":" + std::to_string(e.source().begin.line),
                 "see https://toml.io for the syntax"};
  }
}

}  // namespace broadside::datasets
