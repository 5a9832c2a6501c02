// A value, or one clear error: what went wrong, where, and what to do about it.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace broadside::core {

// The exit codes of the command line. An Error carries the exit code that it causes.
enum class Exit : int { kGood = 0, kFailed = 1, kBadInput = 2, kMissing = 3, kInternal = 4 };

struct Error {
  std::string what;         // "inverse_mass is negative (-1)"
  std::string where = {};   // "scene.toml: body 3"
  std::string advice = {};  // "give a mass above zero, or static = true"
  Exit exit = Exit::kBadInput;

  // One line: "where: what; advice".
  [[nodiscard]] std::string line() const {
    std::string text = where.empty() ? what : where + ": " + what;
    if (!advice.empty()) text += "; " + advice;
    return text;
  }
};

// Calling value() or error() on the wrong alternative ends the program (std::bad_variant_access): check ok() first.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  [[nodiscard]] const T& value() const& { return std::get<0>(state_); }
  [[nodiscard]] T& value() & { return std::get<0>(state_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(state_)); }
  [[nodiscard]] const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Done {};
using Status = Result<Done>;

}  // namespace broadside::core
