#include "datasets/mesh/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

namespace broadside::datasets {

core::Result<std::string> sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return core::Error{"cannot be read", path.string(), "check the path and its permissions"};
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<char> block(std::size_t{1} << 16);
  while (good && file) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    good = EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(file.gcount())) == 1;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
  unsigned length = 0;
  good = good && EVP_DigestFinal_ex(context.get(), sum.data(), &length) == 1;
  if (!good || file.bad())
    return core::Error{"cannot be summed", path.string(), "check that the file can be read", core::Exit::kInternal};
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (unsigned k = 0; k < length; ++k) {
    text += kDigits[sum[k] >> 4];
    text += kDigits[sum[k] & 15];
  }
  return text;
}

}  // namespace broadside::datasets
