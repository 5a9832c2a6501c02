#include "core/trace/file_digest.hpp"

#include <xxhash.h>

#include <fstream>
#include <memory>
#include <vector>

namespace broadside::core {

Result<std::uint64_t> file_digest(const std::filesystem::path& file) {
  constexpr std::size_t kPieceBytes = 1U << 20U;
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{"cannot be read", file.string(), "check that it is there and that its permissions let you"};
  const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(), &XXH64_freeState);
  XXH64_reset(state.get(), 0);
  std::vector<char> piece(kPieceBytes);
  do {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    XXH64_update(state.get(), piece.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  // A folder can be opened like a file, but its first read fails.
  if (!in.eof()) return Error{"reading it failed", file.string(), "check the disk, and that it is a file"};
  return XXH64_digest(state.get());
}

}  // namespace broadside::core
