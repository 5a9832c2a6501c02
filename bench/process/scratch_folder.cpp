#include "bench/process/scratch_folder.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

namespace broadside::bench {

ScratchFolder::ScratchFolder() {
  std::error_code failed;
  const std::filesystem::path all = std::filesystem::temp_directory_path(failed);
  std::string pattern = (all / "broadside-XXXXXX").string();
  if (!failed && mkdtemp(pattern.data()) != nullptr) path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace broadside::bench
