#include "datasets/fetch/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace broadside::datasets {
namespace {

using core::Error;
using core::Exit;

std::string text_of(const Command& command) {
  std::string text;
  for (const std::string& word : command.words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// The last message of a program usually says why it failed. npm's last lines only name its log, so lines with "error"
// are preferred.
std::string complaint(const std::filesystem::path& messages) {
  std::ifstream file(messages);
  std::string last;
  std::string first_error;
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    last = line;
    const bool is_error = line.starts_with("E: ") || line.find("error") != std::string::npos;
    if (is_error && first_error.empty()) first_error = line;
  }
  return first_error.empty() ? last : first_error;
}

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);
  return list;
}

}  // namespace

core::Status run_command(const Command& command) {
  const std::filesystem::path messages = command.folder / "messages.txt";
  const std::string output = command.output_file.empty() ? "/dev/null" : command.output_file.string();
  FileActions actions;
  posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(actions.get(), STDERR_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addchdir_np(actions.get(), command.folder.c_str());

  std::vector<std::string> words = command.words;
  std::vector<std::string> environment{"LC_ALL=C"};  // so that messages are in the language that is searched for here
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (!std::string(*entry).starts_with("LC_ALL=")) environment.emplace_back(*entry);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, words[0].c_str(), actions.get(), nullptr, pointers(words).data(),
                                  pointers(environment).data());
  if (failed == ENOENT)
    return Error{"'" + words[0] + "' is not installed", text_of(command), "install it, or provide the mesh in a folder",
                 Exit::kMissing};
  if (failed != 0)
    return Error{std::string("cannot be run: ") + std::generic_category().message(failed), text_of(command),
                 "check the installation", Exit::kMissing};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    return Error{"was ended by signal " + std::to_string(WTERMSIG(status)), text_of(command), "", Exit::kMissing};
  if (WEXITSTATUS(status) != 0) {
    const std::string why = complaint(messages);
    return Error{"exited with " + std::to_string(WEXITSTATUS(status)) + (why.empty() ? "" : " (" + why + ")"),
                 text_of(command), "check the network, and that package lists are up to date", Exit::kMissing};
  }
  return core::Done{};
}

}  // namespace broadside::datasets
