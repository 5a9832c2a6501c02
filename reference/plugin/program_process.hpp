// A program that was started with two pipes: its standard input and its standard output.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::reference {

// "node 'my engine.mjs' --fast" split into words, by a shell's rules for blanks, quotes and backslashes; nothing is
// expanded. The error: there is no word, or a quote does not end.
core::Result<std::vector<std::string>> words_of(std::string_view command);

class ProgramProcess {
 public:
  // Looked up in PATH as a shell would. It ends when this process ends, and inherits its limits of memory.
  static core::Result<ProgramProcess> start(const std::vector<std::string>& words);
  ProgramProcess(ProgramProcess&& other) noexcept;
  ProgramProcess& operator=(ProgramProcess&&) = delete;
  ProgramProcess(const ProgramProcess&) = delete;
  ProgramProcess& operator=(const ProgramProcess&) = delete;
  // Closes its input and gives it a second to end by itself.
  ~ProgramProcess();

  // Both wait. The error says how the program ended, and after how many bytes.
  core::Status send(std::span<const std::byte> bytes);
  core::Status receive(std::span<std::byte> bytes);

 private:
  ProgramProcess(pid_t id, int to, int from) : id_(id), to_(to), from_(from) {}
  // "the program ended with exit code 3"; waits for it.
  std::string ending();

  pid_t id_;
  int to_;
  int from_;
};

}  // namespace broadside::reference
