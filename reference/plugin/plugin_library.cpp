#include "reference/plugin/plugin_library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace broadside::reference {
namespace {

using core::Error;
using core::Exit;

template <typename Table>
const Table* called(void* handle, const char* name, bool& is_there) {
  using GetTable = const Table* (*)();
  const auto entry = reinterpret_cast<GetTable>(dlsym(handle, name));
  is_there = entry != nullptr;
  return is_there ? entry() : nullptr;
}

}  // namespace

std::string PluginLibrary::take(const broadside_engine& given) {
  if (std::string fault = fault_of(given); !fault.empty()) return fault;
  version1_ = &given;
  table_.abi = BROADSIDE_ENGINE_ABI_2;
  table_.size = sizeof table_;
  table_.id = given.id;
  table_.build = given.build;
  table_.what = given.what;
  table_.memory = given.memory;
  table_.is_exact = given.is_exact;
  table_.margin_m = given.margin_m;
  table_.settings = given.settings;
  table_.setting_count = given.setting_count;
  table_.create = given.create;
  table_.destroy = given.destroy;
  table_.last_error = given.last_error;
  table_.load_boxes = given.load_boxes;
  table_.update_boxes = given.update_boxes;
  table_.find_pairs = given.find_pairs;
  table_.read_pairs = given.read_pairs;
  table_.measure = given.measure;
  table_.read_separations = given.read_separations;
  table_.end = given.end;
  return {};
}

// A later header may have more functions, and an earlier one fewer: the functions that both have are taken.
std::string PluginLibrary::take(const broadside_engine2& given) {
  constexpr std::size_t kLeast = offsetof(broadside_engine2, end) + sizeof given.end;  // of the first version 2
  if (given.abi == BROADSIDE_ENGINE_ABI_2 && given.size < kLeast)
    return "its table has " + std::to_string(given.size) + " bytes, and version 2 has at least " +
           std::to_string(kLeast);
  std::memcpy(&table_, &given, std::min<std::size_t>(given.size, sizeof table_));
  return fault_of(table_);
}

core::Result<std::shared_ptr<const PluginSource>> PluginLibrary::open(const std::filesystem::path& file) {
  const std::string advice = "core/plugin/README.md shows how to build one";
  // A path without a slash would be searched in the system's folders; this loads only the file that was named.
  std::error_code failed;
  const std::filesystem::path absolute = std::filesystem::absolute(file, failed);
  void* handle = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr)
    return Error{std::string("cannot load it: ") + dlerror(),  // NOLINT(concurrency-mt-unsafe)
                 file.string(), advice};
  const std::shared_ptr<PluginLibrary> library(new PluginLibrary(handle));
  bool is_there = false;
  if (const auto* second = called<broadside_engine2>(handle, "broadside_engine_v2", is_there); is_there) {
    const std::string fault = second == nullptr ? "broadside_engine_v2 returned null" : library->take(*second);
    if (!fault.empty()) return Error{fault, file.string(), advice};
    return std::shared_ptr<const PluginSource>(library);
  }
  const auto* first = called<broadside_engine>(handle, "broadside_engine_v1", is_there);
  if (!is_there) return Error{"it exports no broadside_engine_v1 and no broadside_engine_v2", file.string(), advice};
  const std::string fault = first == nullptr ? "broadside_engine_v1 returned null" : library->take(*first);
  if (!fault.empty()) return Error{fault, file.string(), advice};
  return std::shared_ptr<const PluginSource>(library);
}

PluginLibrary::~PluginLibrary() {
  dlclose(handle_);
}

core::Result<void*> PluginLibrary::create(const std::vector<std::uint64_t>& values) const {
  void* self = table_.create(values.data());
  if (self != nullptr) return self;
  const char* why = table_.last_error(nullptr);
  return Error{why != nullptr ? why : "create returned null", std::string(table_.id) + ": create", "", Exit::kMissing};
}

}  // namespace broadside::reference
