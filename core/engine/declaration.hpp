// What an engine declares about itself, so that laws are chosen by its declaration and never by its name.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::core {

// How the value of a key is written.
enum class DeclaredValue {
  kWord,    // one of the allowed words
  kText,    // any text
  kCount,   // a whole number of 1 or more
  kNumber,  // a finite number of 0 or more, in the unit of the key's name
};

// One key of a declaration. There is one table of all keys.
struct DeclarationKey {
  std::string_view key;
  DeclaredValue kind = DeclaredValue::kWord;
  // The value where nothing is declared: what a correct engine of the plainest kind would declare.
  std::string_view default_value;
  std::vector<std::string_view> allowed;  // the words that kWord accepts
  std::string_view what;                  // what the key says, and which laws read it
};

std::span<const DeclarationKey> declaration_keys();

inline constexpr std::string_view kMethodName = "octree-aabb";

class Declaration {
 public:
  // A declaration in which nothing is declared.
  Declaration() = default;
  // An unknown key, an unknown word or text that is not a number is an error that names the known ones.
  static Result<Declaration> parse(const std::map<std::string, std::string>& given, const std::string& where);
  // For declarations that are written in this tree: a wrong one ends the program.
  static Declaration of(const std::map<std::string, std::string>& given);

  [[nodiscard]] bool declares(std::string_view key) const { return declared_.contains(key); }
  // The declared value or the default. The key must be in the table.
  [[nodiscard]] std::string_view text(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  // Only what was declared, by key.
  [[nodiscard]] const std::map<std::string, std::string, std::less<>>& declared() const { return declared_; }

  // Whether the method laws of METHOD hold for it.
  [[nodiscard]] bool follows_method() const { return text("method") == kMethodName; }
  [[nodiscard]] bool turns() const { return text("motion") == "rigid"; }
  [[nodiscard]] bool is_compliant() const { return text("contact_model") == "compliant"; }

  friend bool operator==(const Declaration&, const Declaration&) = default;

 private:
  std::map<std::string, std::string, std::less<>> declared_;
};

// The method of METHOD, as every engine of this tree runs it. twin_of: empty, or the engine whose bits it repeats.
Declaration method_declaration(std::string_view twin_of = {});

}  // namespace broadside::core
