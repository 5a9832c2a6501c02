#include <fmt/format.h>

#include <utility>

#include "bench/bisect/builds.hpp"

namespace broadside::bench::bisect {
namespace {

namespace fs = std::filesystem;

// Path, size and time of change, so that a file that was built again counts as another build.
std::string identity_of(const fs::path& path) {
  std::error_code ignored;
  const auto size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  const auto changed = fs::last_write_time(path, ignored).time_since_epoch().count();
  return fmt::format("{} {} {}", path.string(), size, changed);
}

class GivenBuilds final : public Builds {
 public:
  GivenBuilds(std::vector<Build> list, std::vector<fs::path> paths, std::string program)
      : list_(std::move(list)), paths_(std::move(paths)), program_(std::move(program)) {}

  [[nodiscard]] const std::vector<Build>& list() const override { return list_; }

  core::Result<Made> make(std::size_t k) override {
    const fs::path& path = paths_[k];
    return Made{{path, fs::is_directory(path) ? path / program_ : path}, {}};
  }

 private:
  std::vector<Build> list_;
  std::vector<fs::path> paths_;
  std::string program_;
};

}  // namespace

core::Result<std::unique_ptr<Builds>> given_builds(const BuildsRequest& request) {
  std::vector<std::string> texts{request.good};
  for (const std::string& text : request.between)
    if (text != request.good && text != request.bad) texts.push_back(text);
  texts.push_back(request.bad);
  std::vector<Build> list;
  std::vector<fs::path> paths;
  for (const std::string& text : texts) {
    std::error_code failed;
    const fs::path path = fs::canonical(text, failed);
    if (failed)
      return core::Error{"there is no such build", text,
                         "name a file or a folder; commits need --build 'COMMAND', which builds them"};
    std::string name = fmt::format("{}-{}", list.size(), path.filename().string());
    for (char& c : name)
      if (c == ' ' || c == '\'') c = '_';
    list.push_back({std::move(name), text, identity_of(path)});
    paths.push_back(path);
  }
  return std::unique_ptr<Builds>(std::make_unique<GivenBuilds>(std::move(list), std::move(paths), request.program));
}

}  // namespace broadside::bench::bisect
