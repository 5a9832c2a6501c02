#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <utility>

#include "bench/bisect/builds.hpp"
#include "bench/process/program.hpp"
#include "bench/record/run_plan.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench::bisect {
namespace {

namespace fs = std::filesystem;

// A clone, with the commit that was last built in it.
struct Tree {
  fs::path root;
  std::optional<std::size_t> holds;
};

class CommitBuilds final : public Builds {
 public:
  explicit CommitBuilds(BuildsRequest request) : request_(std::move(request)) {}

  core::Status open() {
    std::error_code failed;
    if (!fs::is_directory(request_.repository, failed))
      return core::Error{"there is no such folder", request_.repository, "name a git repository with --repository"};
    request_.repository = fs::canonical(request_.repository).string();
    if (core::Status s = prepare_folder(request_.folder / "logs"); !s) return s;
    if (!git({"rev-parse", "--git-dir"}))
      return core::Error{"it is no git repository", request_.repository,
                         "name one with --repository; for builds that exist already, leave out --build"};
    auto good = commit(request_.good);
    if (!good) return good.error();
    auto bad = commit(request_.bad);
    if (!bad) return bad.error();
    if (good.value() == bad.value())
      return core::Error{"GOOD and BAD are the same commit", request_.good, "name two commits, the older one first"};
    if (auto is_before = git({"merge-base", "--is-ancestor", good.value(), bad.value()}); !is_before)
      return core::Error{"GOOD is not an ancestor of BAD, so no commits lead from GOOD to BAD",
                         request_.good + ".." + request_.bad, "name the older commit first"};
    const std::string format = "--format=%H%x09%h%x09%s";
    auto first = git({"log", "-1", format, good.value()});
    if (!first) return first.error();
    auto others = git({"log", "--first-parent", "--reverse", format, good.value() + ".." + bad.value()});
    if (!others) return others.error();
    std::istringstream lines(first.value() + others.value());
    for (std::string line; std::getline(lines, line);) {
      std::istringstream parts(line);
      std::string id, name, subject;
      std::getline(parts, id, '\t');
      std::getline(parts, name, '\t');
      std::getline(parts, subject);
      list_.push_back({name, name + " " + subject, id});
    }
    return core::Done{};
  }

  [[nodiscard]] const std::vector<Build>& list() const override { return list_; }

  core::Result<Made> make(std::size_t k) override {
    Tree& tree = k == 0 ? good_ : other_;
    tree.root = fs::absolute(request_.folder) / (k == 0 ? "good-tree" : "tree");
    Made made{{tree.root, tree.root / request_.program}, {}};
    if (tree.holds == k) return made;
    tree.holds.reset();
    if (core::Status s = check_out(tree, k); !s) return s.error();
    const fs::path log = fs::absolute(request_.folder) / "logs" / (list_[k].name + ".build.log");
    auto code = run_in_shell(request_.command, tree.root, log, request_.lock);
    if (!code) return code.error();
    if (code.value() != 0) {
      made.fault = fmt::format("does not build: exit code {}{}", code.value(), said_in(log));
    } else if (!request_.program.empty() && !fs::exists(made.place.program)) {
      made.fault = "was built, but there is no " + request_.program;
    } else {
      tree.holds = k;
    }
    return made;
  }

 private:
  core::Status check_out(const Tree& tree, std::size_t k) const {
    std::error_code ignored;
    if (!request_.program.empty()) fs::remove(tree.root / request_.program, ignored);
    const std::vector<std::string> words{"-C",      tree.root.string(), "checkout",       "--quiet",
                                         "--force", "--detach",         list_[k].identity};
    if (fs::exists(tree.root / ".git") && git(words).ok()) return core::Done{};
    // There is no clone yet, or making it or checking out was interrupted, which leaves git's own locks behind.
    fs::remove_all(tree.root, ignored);
    if (auto done = git({"clone", "--quiet", "--shared", "--no-checkout", request_.repository, tree.root.string()});
        !done)
      return done.error();
    if (auto done = git(words); !done) return done.error();
    return core::Done{};
  }

  [[nodiscard]] core::Result<std::string> commit(const std::string& text) const {
    auto id = git({"rev-parse", "--verify", "--quiet", "--end-of-options", text + "^{commit}"});
    if (!id)
      return core::Error{"there is no such commit in " + request_.repository, text,
                         "name a commit, branch or tag; for builds that exist already, leave out --build"};
    return id.value().substr(0, id.value().find('\n'));
  }

  // What git prints. An error when it fails.
  [[nodiscard]] core::Result<std::string> git(std::vector<std::string> arguments) const {
    const fs::path log = request_.folder / "logs" / "git.log";
    const std::string what = arguments[0] == "-C" ? arguments[2] : arguments[0];
    if (arguments[0] != "-C" && what != "clone") {
      const std::vector<std::string> at{"-C", request_.repository};
      arguments.insert(arguments.begin(), at.begin(), at.end());
    }
    const auto code = run_program("git", arguments, log);
    if (!code) return code.error();
    if (code.value() != 0)
      return core::Error{"git " + what + " fails: " + last_line(log), request_.repository, "see " + log.string()};
    return core::read_whole_file(log);
  }

  BuildsRequest request_;
  std::vector<Build> list_;
  Tree good_, other_;
};

}  // namespace

core::Result<std::unique_ptr<Builds>> commit_builds(const BuildsRequest& request) {
  auto builds = std::make_unique<CommitBuilds>(request);
  if (core::Status s = builds->open(); !s) return s.error();
  return std::unique_ptr<Builds>(std::move(builds));
}

}  // namespace broadside::bench::bisect
