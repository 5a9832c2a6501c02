#include "bench/bisect/shell_command.hpp"

#include <array>
#include <fstream>
#include <utility>

#include "bench/process/interrupt.hpp"
#include "bench/process/program.hpp"

namespace broadside::bench::bisect {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string filled_in(const std::string& command, const BuildPlace& place, const std::filesystem::path& out) {
  const std::array<std::pair<std::string, std::string>, 3> words{
      std::pair{std::string("{build}"), quoted(place.build.string())},
      std::pair{std::string("{program}"), quoted(place.program.string())},
      std::pair{std::string("{out}"), quoted(out.string())}};
  std::string result;
  for (std::size_t at = 0; at < command.size();) {
    bool is_word = false;
    for (const auto& [word, value] : words) {
      if (command.compare(at, word.size(), word) != 0) continue;
      result += value;
      at += word.size();
      is_word = true;
      break;
    }
    if (!is_word) result += command[at++];
  }
  return result;
}

core::Result<int> run_in_shell(const std::string& text, const std::filesystem::path& folder,
                               const std::filesystem::path& log, int lock) {
  // The second line keeps the shell from replacing itself by the command, so that a signal ends the command alone.
  auto code = run_program("/bin/sh", {"-c", "cd -- " + quoted(folder.string()) + " || exit 126\n" + text + "\nexit $?"},
                          log, lock);
  if (is_interrupted())
    return core::Error{"interrupted: the same command goes on from here", "bisect", "", core::Exit::kMissing};
  return code;
}

std::string said_in(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find("error:") != std::string::npos || line.find("error[") != std::string::npos) return ": " + line;
    if (!line.empty()) last = line;
  }
  return last.empty() ? "" : ": " + last;
}

}  // namespace broadside::bench::bisect
