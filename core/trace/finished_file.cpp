#include "core/trace/finished_file.hpp"

#include <string>
#include <system_error>
#include <vector>

#include "core/trace/hdf5_sink.hpp"
#include "core/trace/trace_header.hpp"
#include "core/trace/vtkhdf_group.hpp"

namespace broadside::core {
namespace {

constexpr std::uint64_t kWasteShare = 16;
// The scene and HDF5's own structures are not waste, and seldom need more than this.
constexpr std::uint64_t kStructureBytes = 1U << 20U;

Handle open_hdf5(PartFile& part, unsigned flags) {
  const Handle access = part.access_properties();
  if (!access) return {};
  return {H5Fopen(part.path().c_str(), flags, access.get()), H5Fclose};
}

std::vector<std::string> names_in_root(hid_t file) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names);
  return names;
}

}  // namespace

Handle create_hdf5(PartFile& part) {
  const Handle access = part.access_properties();
  if (!access) return {};
  return {H5Fcreate(part.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
}

bool is_worth_compacting(const PartFile& part, std::uint64_t stored) {
  return part.size() > stored + stored / kWasteShare + kStructureBytes;
}

std::unique_ptr<PartFile> compacted(PartFile& part, const std::filesystem::path& path) {
  auto made = PartFile::create(std::filesystem::path(path) += ".compact");
  if (!made) return nullptr;
  std::unique_ptr<PartFile> copy = std::move(made).value();
  bool good = false;
  {
    const Handle source = open_hdf5(part, H5F_ACC_RDONLY);
    Handle target = create_hdf5(*copy);
    if (source && target) {
      Hdf5Sink sink(target.get());
      sink.text("/", "format", "broadside-trace");
      sink.number("/", "format_version", Element::kU32, &kTraceFormatVersion);
      good = sink.ok();
      for (const std::string& name : names_in_root(source.get()))
        good = good && H5Ocopy(source.get(), name.c_str(), target.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0;
    }
    good = target.close() && good && copy->commit();
  }
  hdf5_reason();
  if (good) return copy;
  std::error_code ignored;
  std::filesystem::remove(copy->path(), ignored);
  return nullptr;
}

void add_views(PartFile& complete, std::uint64_t frames, std::uint64_t bodies) {
  if (frames == 0 || bodies == 0) return;
  bool good = false;
  {
    Handle file = open_hdf5(complete, H5F_ACC_RDWR);
    Hdf5Sink sink(file.get());
    if (file) write_vtkhdf_group(sink, frames, bodies);
    good = file && sink.ok();
    good = file.close() && good;
  }
  if (good && complete.commit()) return;
  complete.rollback();
  hdf5_reason();
}

}  // namespace broadside::core
