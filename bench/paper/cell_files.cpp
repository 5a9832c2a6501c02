#include "bench/paper/cell_files.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "bench/run_plan.hpp"
#include "core/rows.hpp"
#include "reports/figures.hpp"

namespace broadside::bench::paper {
namespace {

// FNV-1a with a separator, so that neighboring fields cannot run together.
class Hash {
 public:
  void add(const std::string& text) {
    for (const char c : text) state_ = (state_ ^ static_cast<unsigned char>(c)) * kPrime;
    state_ = (state_ ^ 0xffU) * kPrime;
  }
  [[nodiscard]] std::string digits() const { return reports::hexadecimal(state_).substr(2); }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

std::string as_file_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '=' && c != '-' && c != '+' && c != '.') c = '-';
  return text.substr(0, 120);
}

std::string scene_part(const core::Stamp& stamp) {
  Hash hash;
  hash.add(reports::hexadecimal(stamp.scene_digest));
  hash.add(stamp.broadside_build);
  hash.add(stamp.machine);
  return as_file_name(stamp.scene_name) + "+" + hash.digits();
}

}  // namespace

std::string CellKey::name() const {
  Hash hash;
  for (const std::string& part :
       {reports::hexadecimal(stamp.scene_digest), stamp.engine, stamp.settings, stamp.broadside_build, stamp.machine,
        std::to_string(frames), std::to_string(every), std::to_string(runs), std::string(wants_memory ? "m" : "")})
    hash.add(part);
  std::string name = stamp.scene_name + "+" + stamp.engine;
  if (!stamp.settings_short.empty()) name += "+" + stamp.settings_short;
  std::replace(name.begin(), name.end(), ',', '+');
  return as_file_name(std::move(name)) + "+" + hash.digits();
}

core::Status CellFiles::prepare() const {
  for (const char* part : {"cells", "work"})
    if (core::Status s = prepare_folder(folder_ / part); !s) return s;
  return core::Done{};
}

std::optional<PaperRow> CellFiles::finished(const CellKey& key) const {
  auto rows = read_paper_rows(folder_ / "cells" / (key.name() + ".json"));
  if (!rows || rows.value().size() != 1) return std::nullopt;
  return std::move(rows).value().front();
}

core::Status CellFiles::finish(const CellKey& key, const PaperRow& row) const {
  if (core::Status s = write_paper_rows(folder_ / "cells" / (key.name() + ".json"), {row}); !s) return s;
  std::error_code ignored;
  for (std::uint32_t r = 0; r < key.runs; ++r) std::filesystem::remove_all(run_folder(key, r), ignored);
  return core::Done{};
}

std::filesystem::path CellFiles::run_folder(const CellKey& key, std::uint32_t repetition) const {
  CellKey of_run = key;  // one more run leaves the others as they are
  of_run.runs = 0;
  of_run.wants_memory = false;
  return folder_ / "work" / (of_run.name() + ".run" + std::to_string(repetition));
}

std::optional<core::Sample> CellFiles::run(const CellKey& key, std::uint32_t repetition) const {
  auto rows = core::read_rows(run_folder(key, repetition));
  if (!rows || rows.value().samples.size() != 1) return std::nullopt;
  return std::move(rows).value().samples.front();
}

core::Status CellFiles::keep_run(const CellKey& key, const core::Sample& sample) const {
  const std::filesystem::path folder = run_folder(key, sample.repetition);
  if (core::Status s = prepare_folder(folder); !s) return s;
  return core::write_samples(folder / "samples.json", {sample});
}

std::filesystem::path CellFiles::work(const CellKey& key) const {
  return folder_ / "work" /
         (scene_part(key.stamp) + "-" + std::to_string(key.frames) + "-" + std::to_string(key.every));
}

void CellFiles::drop_work(const CellKey& key) const {
  std::error_code ignored;
  std::filesystem::remove_all(work(key), ignored);
}

}  // namespace broadside::bench::paper
