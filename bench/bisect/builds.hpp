// The builds of a bisection, from the oldest to the newest.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/bisect/shell_command.hpp"
#include "core/result.hpp"

namespace broadside::bench::bisect {

struct Build {
  std::string name;      // short; also the name of its folder: "3-broadside", "a44ec5a"
  std::string title;     // for people: the path as given, or the commit and its subject
  std::string identity;  // what distinguishes it from any other: path, size and time of change; the whole commit id
};

// Where a build lies, or why there is none.
struct Made {
  BuildPlace place;
  std::string fault;  // "does not build: foo.cpp:3: error ..."; empty when it is there
};

class Builds {
 public:
  virtual ~Builds() = default;
  // At least two; the first is the good one.
  [[nodiscard]] virtual const std::vector<Build>& list() const = 0;
  // Makes build k. The place of the good build, 0, stays valid; that of any other build is valid until the next call.
  virtual core::Result<Made> make(std::size_t k) = 0;
};

struct BuildsRequest {
  std::string good, bad;             // files or folders; commits where `command` says how to build
  std::vector<std::string> between;  // files or folders, oldest first
  std::string command;               // builds a commit, in the root of its tree; empty: the builds are given
  std::string repository = ".";
  std::string program;           // path of the program within a build that is a folder
  std::filesystem::path folder;  // trees and logs of commits lie in it
  int lock = -1;                 // of the folder's FolderLock
};

// Files or folders as they are given; each must be there.
core::Result<std::unique_ptr<Builds>> given_builds(const BuildsRequest& request);

// The commits from good to bad along first parents, so a merge counts as one. They are built in clones that share the
// repository's objects; the repository itself and its working tree are not touched. The good commit has a clone of its
// own; all others are built one after the other in a second clone, so that building is incremental. `program` is
// removed before each build, so that the program of an earlier commit is not taken for the new one.
core::Result<std::unique_ptr<Builds>> commit_builds(const BuildsRequest& request);

}  // namespace broadside::bench::bisect
