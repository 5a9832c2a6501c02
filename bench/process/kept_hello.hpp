// What an installed engine said of itself, kept beside it: asking starts Node and loads its package, a quarter of a
// second each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace broadside::bench {

// The stamp names what the answer depends on: this program's build, the interpreter, and the package that npm
// installed. An answer of another stamp does not count; whether it can be read is the caller's to see.
class KeptHello {
 public:
  // Of the engine whose program lies in this folder, in which npm installed its package.
  explicit KeptHello(const std::filesystem::path& program_folder);

  [[nodiscard]] std::optional<std::string> answer() const;
  // Where the folder cannot be written, the next call asks again.
  void keep(const std::string& answer) const;

 private:
  std::filesystem::path file_;
  std::string stamp_;  // empty where something that belongs to it cannot be read: then nothing is kept
};

}  // namespace broadside::bench
