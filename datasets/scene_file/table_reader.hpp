// Typed reading of one table of a scene file. Wrong types, numbers out of range and unknown keys are reported as the
// file's error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec3.hpp"
#include "core/result.hpp"
#include "datasets/scene_file/document.hpp"

namespace broadside::datasets {

// The file's name and its first error, shared by all readers of its tables.
struct FileErrors {
  std::string file;
  std::optional<core::Error> first;

  void add(std::uint32_t line, std::string what, std::string advice);
};

// Each getter leaves its target unchanged and returns false when the key is absent or wrong. finish() reports every key
// that was never asked for as an error that names the nearest key that was.
class TableReader {
 public:
  // `what` names the table in errors: "body", "the scene".
  TableReader(const Node& table, std::string what, FileErrors& errors);

  bool text(std::string_view key, std::string& out);
  bool flag(std::string_view key, bool& out);
  // Whole numbers in low ... high.
  bool whole(std::string_view key, std::uint64_t low, std::uint64_t high, std::uint64_t& out);
  bool whole(std::string_view key, std::uint32_t low, std::uint32_t high, std::uint32_t& out);
  // Finite numbers, including whole ones. For a float, the number is rounded once and must be finite after that.
  bool number(std::string_view key, double& out);
  bool number(std::string_view key, float& out);
  // Requires a finite number above zero.
  bool positive(std::string_view key, double& out);
  bool numbers(std::string_view key, std::size_t count, std::vector<double>& out);
  bool vec3(std::string_view key, core::Vec3& out);
  bool texts(std::string_view key, std::vector<std::string>& out);

  // Null when the key is absent or is something else (then with an error).
  const Node* table(std::string_view key);
  // The tables of [[key]]; empty when the key is absent.
  std::vector<const Node*> tables(std::string_view key);

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_text(std::string_view key) const;
  [[nodiscard]] std::uint32_t line() const { return table_.line; }
  [[nodiscard]] std::uint32_t line_of(std::string_view key) const;
  void fail(std::string_view key, std::string what, std::string advice);
  void finish();

 private:
  const Node* find(std::string_view key);
  bool finite_float(std::string_view key, double value, float& out);

  const Node& table_;
  std::string what_;
  FileErrors& errors_;
  std::vector<std::string_view> asked_;
};

}  // namespace broadside::datasets
