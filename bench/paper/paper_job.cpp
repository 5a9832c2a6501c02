#include "bench/paper/paper_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>

#include "bench/build_facts.hpp"
#include "bench/campaign/cell_id.hpp"
#include "bench/campaign/varied_values.hpp"
#include "bench/paper/cell_cost.hpp"
#include "bench/paper/cell_files.hpp"
#include "bench/paper/measure_group.hpp"
#include "bench/paper/paper_scene.hpp"
#include "bench/process/interrupt.hpp"

namespace broadside::bench::paper {
namespace {

constexpr std::string_view kKey = "paper";

class OpenPaperJob : public campaign::OpenJob {
 public:
  OpenPaperJob(const PaperRequest& request, std::vector<PaperCell> cells, std::filesystem::path folder)
      : request_(request), cells_(std::move(cells)), folder_(std::move(folder)) {}

  // Cheap cells first, so that after an interrupt the report has as many results as possible.
  [[nodiscard]] double rank_of(std::size_t first, std::size_t count) const override {
    return paper::rank_of(group(first, count), request_.plan.runs);
  }

  [[nodiscard]] core::Status do_group(std::size_t first, std::size_t count) const override {
    auto rows = measure_group(group(first, count), {.folder = folder_,
                                                    .runs = request_.plan.runs,
                                                    .allow_stand_in = request_.allow_stand_in,
                                                    .keeps_traces = request_.keeps_traces,
                                                    .progress = {},
                                                    .campaign = cells_,
                                                    .limit_s = request_.plan.limit_s});
    if (!rows && !is_interrupted()) return rows.error();
    return core::Done{};
  }

  [[nodiscard]] core::Status add_to_merge(const std::filesystem::path& out) const override {
    return write_paper_rows(out / "rows.json", rows_of(cells_, folder_));
  }

 private:
  [[nodiscard]] std::span<const PaperCell> group(std::size_t first, std::size_t count) const {
    return std::span(cells_).subspan(first, count);
  }

  PaperRequest request_;
  std::vector<PaperCell> cells_;
  std::filesystem::path folder_;
};

// A scene that cannot be made here has no digest. Its name is hashed instead, and its cells will say why.
std::uint64_t digest_of_scene(const PaperCell& cell, bool allow_stand_in) {
  const auto scene = make_paper_scene(cell, allow_stand_in);
  return scene ? core::scene_digest(scene.value()) : campaign::hashed(cell.scene);
}

class PaperJob : public campaign::Job {
 public:
  explicit PaperJob(PaperRequest request) : request_(std::move(request)) {}

  [[nodiscard]] std::string_view key() const override { return kKey; }
  [[nodiscard]] std::string text() const override { return text_of(request_); }

  [[nodiscard]] core::Result<std::vector<campaign::ManifestCell>> plan() const override {
    auto cells = plan_cells(request_.experiments, request_.plan, request_.device);
    if (!cells) return cells.error();
    std::vector<campaign::ManifestCell> planned;
    const PaperCell* last = nullptr;
    std::uint64_t digest = 0;
    for (const PaperCell& cell : cells.value()) {
      if (last == nullptr || !takes_turns(*last, cell)) digest = digest_of_scene(cell, request_.allow_stand_in);
      last = &cell;
      const campaign::CellWork work{.scene = cell.scene,
                                    .engine = cell.engine,
                                    .frames = static_cast<std::uint32_t>(cell.frames),
                                    .repetitions = cell.is_timed ? request_.plan.runs : 0,
                                    .stand_in = request_.allow_stand_in};
      auto made = campaign::identified(
          work, digest, fmt::format("{}|{}|{}|{}", cell.every, cell.wants_memory, cell.left_out, request_.machine));
      if (!made) return made.error();
      made.value().turns = campaign::id_of(
          fmt::format("{:016x}|{}|{}|{}|{}", digest, cell.frames, cell.every, build_line(), request_.machine));
      planned.push_back(std::move(made).value());
    }
    return planned;
  }

  [[nodiscard]] core::Result<std::unique_ptr<campaign::OpenJob>> open(
      std::span<const campaign::ManifestCell> cells, const std::filesystem::path& folder) const override {
    auto planned = planned_cells(request_, cells);
    if (!planned) return planned.error();
    return std::unique_ptr<campaign::OpenJob>(
        std::make_unique<OpenPaperJob>(request_, std::move(planned).value(), folder));
  }

 private:
  PaperRequest request_;
};

// Returns 0 when the text is not a count of bodies.
std::uint32_t count_of(const std::string& text) {
  std::uint32_t count = 0;
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), count);
  return bad == std::errc() && end == text.data() + text.size() ? count : 0;
}

core::Result<campaign::JobPointer> read(datasets::TableReader& table, datasets::FileErrors& errors) {
  PaperRequest request;
  std::string engine;
  table.texts(kKey, request.experiments);
  table.text("engine", engine);
  table.whole("frames", 1U, 1'000'000U, request.plan.frames);
  table.whole("repetitions", 1U, 10'000U, request.plan.runs);
  table.flag("stand_in", request.allow_stand_in);
  table.positive("limit_s", request.plan.limit_s);
  for (const auto& [key, list] : campaign::read_values(table.table("vary"), errors)) {
    if (key == "models") request.plan.models = list;
    if (key == "counts")
      for (const std::string& text : list) request.plan.counts.push_back(count_of(text));
    if (key != "models" && key != "counts")
      errors.add(table.line(), "[vary] " + key + " is not a value that the paper varies", "vary models and counts");
  }
  if (std::count(request.plan.counts.begin(), request.plan.counts.end(), 0U) > 0)
    errors.add(table.line(), "[vary] counts has an entry that is not a whole number above 0",
               "give for example counts = [50]");
  if (errors.first) return *errors.first;
  auto device = choose_device(engine);
  if (!device) return device.error();
  request.device = std::move(device).value();
  return paper_job(request);
}

core::Result<campaign::JobPointer> from_text(std::string_view text) {
  auto request = request_from(text);
  if (!request) return request.error();
  return paper_job(request.value());
}

}  // namespace

campaign::JobKind paper_job_kind() {
  return {.key = kKey, .read = read, .from_text = from_text};
}

campaign::JobPointer paper_job(const PaperRequest& request) {
  return std::make_shared<const PaperJob>(request);
}

core::Result<std::vector<PaperCell>> planned_cells(const PaperRequest& request,
                                                   std::span<const campaign::ManifestCell> cells) {
  auto planned = plan_cells(request.experiments, request.plan, request.device);
  if (!planned) return planned.error();
  if (planned.value().size() != cells.size())
    return core::Error{"its cells are not those that the paper's experiments need", "manifest.json", "plan it again"};
  for (std::size_t k = 0; k < cells.size(); ++k) {
    planned.value()[k].id = cells[k].id;
    planned.value()[k].turns = cells[k].turns;
  }
  return planned;
}

std::vector<PaperRow> rows_of(std::span<const PaperCell> cells, const std::filesystem::path& folder) {
  const CellFiles files(folder);
  std::vector<PaperRow> rows;
  for (const PaperCell& cell : cells) rows.push_back(files.row(cell));
  return rows;
}

}  // namespace broadside::bench::paper
