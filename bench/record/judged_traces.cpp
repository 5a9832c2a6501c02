#include "bench/record/judged_traces.hpp"

#include <fmt/format.h>

#include <system_error>

#include "bench/build_facts.hpp"
#include "core/trace/file_digest.hpp"
#include "core/whole_file.hpp"

namespace broadside::bench {
namespace {

constexpr const char* kJudgedFile = "judged.txt";
constexpr const char* kRowFiles[] = {"verdicts.json", "energy.json"};

// The file's text, empty when there is no file. An absent or damaged file means that everything is judged again.
std::string kept_text(const std::filesystem::path& folder) {
  auto text = core::read_whole_file(folder / kJudgedFile);
  return text ? std::move(text).value() : std::string();
}

core::Result<std::string> line_of(const std::filesystem::path& folder, const std::string& name) {
  auto digest = core::file_digest(folder / name);
  if (!digest) return digest.error();
  return fmt::format("{:#018x} {}\n", digest.value(), name);
}

}  // namespace

core::Result<std::string> JudgedTraces::text_of(const std::vector<core::Cell>& cells) const {
  std::string text = build_line() + "\n";
  for (const core::Cell& cell : cells) {
    if (cell.state != core::CellState::kRecorded || cell.trace_file.empty()) continue;
    auto line = line_of(folder_, cell.trace_file);
    if (!line) return line;
    text += line.value();
  }
  for (const char* name : kRowFiles) {
    auto line = line_of(folder_, name);
    if (!line) return line;
    text += line.value();
  }
  return text;
}

core::Status JudgedTraces::drop_changed_rows() const {
  const std::string kept = kept_text(folder_);
  bool are_kept = kept.starts_with(build_line() + "\n");
  for (const char* name : kRowFiles) {
    const auto line = line_of(folder_, name);
    are_kept = are_kept && line.ok() && kept.find("\n" + line.value()) != std::string::npos;
  }
  if (are_kept) return core::Done{};
  for (const char* name : {kJudgedFile, kRowFiles[0], kRowFiles[1]}) {
    std::error_code failed;
    std::filesystem::remove(folder_ / name, failed);
    if (failed)
      return core::Error{"cannot be removed: " + failed.message(), (folder_ / name).string(),
                         "remove it, or choose another --out"};
  }
  return core::Done{};
}

core::Result<bool> JudgedTraces::are_of(const std::vector<core::Cell>& cells) const {
  const std::string kept = kept_text(folder_);
  if (kept.empty()) return false;
  const auto now = text_of(cells);
  if (!now) return now.error();
  return now.value() == kept;
}

core::Status JudgedTraces::keep(const std::vector<core::Cell>& cells) const {
  const auto text = text_of(cells);
  if (!text) return text.error();
  return core::write_whole_file(folder_ / kJudgedFile, text.value());
}

}  // namespace broadside::bench
