// From Result to Python's exceptions: the one line of a core::Error, and the exit code that it leads to.
#pragma once

#include <stdexcept>
#include <utility>

#include "core/result.hpp"

namespace broadside::bench::python {

// Becomes broadside.BadInput, Missing or Internal at the border to Python.
class Raised : public std::runtime_error {
 public:
  explicit Raised(const core::Error& error) : std::runtime_error(error.line()), exit_(error.exit) {}
  [[nodiscard]] core::Exit exit() const { return exit_; }

 private:
  core::Exit exit_;
};

// The value, or the exception.
template <typename T>
T take(core::Result<T> result) {
  if (!result) throw Raised(result.error());
  return std::move(result).value();
}

}  // namespace broadside::bench::python
