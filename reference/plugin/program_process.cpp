#include "reference/plugin/program_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

namespace broadside::reference {
namespace {

using core::Error;
using core::Exit;
using core::Status;

constexpr int kPolls = 100;              // while waiting for an end
constexpr useconds_t kPoll_us = 10'000;  // together a second
constexpr int kNoProgram = 127;          // the code that shells use

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Takes a word from the front of the text, which does not begin with a blank.
core::Result<std::string> take_word(std::string_view& text) {
  std::string word;
  char quote = '\0';
  while (!text.empty() && (quote != '\0' || !is_blank(text[0]))) {
    const char c = text[0];
    text.remove_prefix(1);
    if (quote == '\0' && (c == '\'' || c == '"')) {
      quote = c;
    } else if (quote != '\0' && c == quote) {
      quote = '\0';
    } else if (c == '\\' && quote != '\'' && !text.empty()) {
      word += text[0];
      text.remove_prefix(1);
    } else {
      word += c;
    }
  }
  if (quote != '\0') return Error{std::string("a quote ") + quote + " does not end", "", "close it"};
  return word;
}

[[noreturn]] void become(char* const* argv, pid_t parent, int in, int out, int failure) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNoProgram);
  setpgid(0, 0);  // Ctrl-C is for the harness, which then ends this process
  signal(SIGPIPE, SIG_DFL);
  dup2(in, STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  execvp(argv[0], argv);
  const int why = errno;
  [[maybe_unused]] const ssize_t told = write(failure, &why, sizeof why);
  _exit(kNoProgram);
}

struct Pipe {
  int from = -1;
  int to = -1;
  bool open() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    from = ends[0];
    to = ends[1];
    return true;
  }
  void close_both() {
    for (int* end : {&from, &to})
      if (*end >= 0) close(std::exchange(*end, -1));
  }
};

}  // namespace

core::Result<std::vector<std::string>> words_of(std::string_view command) {
  std::vector<std::string> words;
  while (true) {
    while (!command.empty() && is_blank(command[0])) command.remove_prefix(1);
    if (command.empty()) break;
    auto word = take_word(command);
    if (!word) return word.error();
    words.push_back(std::move(word).value());
  }
  if (words.empty()) return Error{"there is no program", "", "name one: 'node engine.mjs'"};
  return words;
}

core::Result<ProgramProcess> ProgramProcess::start(const std::vector<std::string>& words) {
  std::vector<std::string> owned = words;
  std::vector<char*> argv;
  argv.reserve(owned.size() + 1);
  for (std::string& word : owned) argv.push_back(word.data());
  argv.push_back(nullptr);
  Pipe in;
  Pipe out;
  Pipe failure;
  const auto close_all = [&] {
    for (Pipe* pipe : {&in, &out, &failure}) pipe->close_both();
  };
  if (!in.open() || !out.open() || !failure.open()) {
    close_all();
    return Error{std::string("no pipe: ") + std::generic_category().message(errno), words[0], "", Exit::kInternal};
  }
  signal(SIGPIPE, SIG_IGN);  // send then returns an error for a program that has ended
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) become(argv.data(), parent, in.from, out.to, failure.to);
  close(std::exchange(failure.to, -1));
  int why = child < 0 ? errno : 0;
  if (child > 0 && read(failure.from, &why, sizeof why) != sizeof why) why = 0;
  if (why != 0) {
    close_all();
    if (child > 0) waitpid(child, nullptr, 0);
    return Error{std::string("cannot start it: ") + std::generic_category().message(why), words[0],
                 "name a program that can be run"};
  }
  ProgramProcess process(child, std::exchange(in.to, -1), std::exchange(out.from, -1));
  close_all();
  return process;
}

ProgramProcess::ProgramProcess(ProgramProcess&& other) noexcept
    : id_(std::exchange(other.id_, -1)), to_(std::exchange(other.to_, -1)), from_(std::exchange(other.from_, -1)) {}

ProgramProcess::~ProgramProcess() {
  if (to_ >= 0) close(to_);
  if (from_ >= 0) close(from_);
  if (id_ <= 0) return;
  for (int k = 0; k < kPolls; ++k) {
    if (waitpid(id_, nullptr, WNOHANG) != 0) return;
    usleep(kPoll_us);
  }
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

std::string ProgramProcess::ending() {
  int status = 0;
  pid_t ended = 0;
  for (int k = 0; k < kPolls && ended == 0; ++k) {
    ended = waitpid(id_, &status, WNOHANG);
    if (ended == 0) usleep(kPoll_us);
  }
  if (ended != id_) return "the program closed its standard output";
  id_ = -1;
  if (WIFSIGNALED(status))
    return "the program was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
           strsignal(WTERMSIG(status)) +  // NOLINT(concurrency-mt-unsafe)
           ")";
  return "the program ended with exit code " + std::to_string(WEXITSTATUS(status));
}

Status ProgramProcess::send(std::span<const std::byte> bytes) {
  const std::size_t all = bytes.size();
  while (!bytes.empty()) {
    const ssize_t sent = write(to_, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0)
      return Error{ending() + " before it read its input (" + std::to_string(all) + " bytes)", "", "", Exit::kMissing};
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return core::Done{};
}

Status ProgramProcess::receive(std::span<std::byte> bytes) {
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t got = read(from_, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      const std::string after =
          have == 0 ? std::string(" instead of answering")
                    : " after " + std::to_string(have) + " of " + std::to_string(bytes.size()) + " bytes of its answer";
      return Error{ending() + after, "", "what it wrote to standard error may say why", Exit::kMissing};
    }
    have += static_cast<std::size_t>(got);
  }
  return core::Done{};
}

}  // namespace broadside::reference
