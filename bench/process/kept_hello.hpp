// The description of an installed engine, kept beside it, because asking for it starts Node and loads the package, a
// quarter of a second each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace broadside::bench {

// The stamp names everything that the answer depends on: this program's build, the interpreter, and the package that
// npm installed. An answer with another stamp is ignored; the caller must check that an answer can be parsed.
class KeptHello {
 public:
  // For the engine whose program lies in this folder, where npm also installed its package.
  explicit KeptHello(const std::filesystem::path& program_folder);

  [[nodiscard]] std::optional<std::string> answer() const;
  // Where the folder cannot be written, the next call asks again.
  void keep(const std::string& answer) const;

 private:
  std::filesystem::path file_;
  std::string stamp_;  // empty where a part of it cannot be read: then nothing is kept
};

}  // namespace broadside::bench
