#include "bench/timing/box_race.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/process/broad_phase_cell.hpp"
#include "bench/process/interrupt.hpp"
#include "bench/timing/parted_frame.hpp"
#include "core/engine/search_path.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/long_boxes.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

core::Error pairs_interrupted() {
  return {"interrupted", "pairs", "", core::Exit::kMissing};
}

// One frame's digest is that of its pairs; further frames are mixed with their number.
void add_frame(RaceRow& row, std::uint64_t digest) {
  row.digest += row.frames == 0 ? digest : core::splitmix64(digest + row.frames);
  ++row.frames;
}

core::Status run_frame(core::BroadPhase& broad, const std::vector<core::Box>& boxes, RaceRow& row) {
  const auto start = Clock::now();
  if (core::Status s = broad.update(boxes); !s) return s;
  const auto updated = Clock::now();
  if (core::Status s = broad.find(); !s) return s;
  const auto found = Clock::now();
  auto pairs = broad.read_back();
  if (!pairs) return pairs.error();
  const auto read = Clock::now();
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  row.update_s += seconds(start, updated);
  row.find_s += seconds(updated, found);
  row.read_back_s += seconds(found, read);
  row.filter_s += pairs.value().filter_s;
  row.pairs += pairs.value().pairs.size();
  row.raw += pairs.value().raw;
  add_frame(row, core::pair_digest(pairs.value().pairs));
  return core::Done{};
}

core::Status run_parted_frame(core::BroadPhase& broad, const std::vector<core::Box>& boxes,
                              const std::vector<std::uint8_t>& is_static, RaceRow& row) {
  std::uint64_t digest = 0;
  const auto found = find_in_parts(broad, boxes, is_static, row.parts,
                                   [&](std::span<const core::Pair> pairs) { digest += core::pair_digest(pairs); });
  if (!found) return found.error();
  const PartedFrame& f = found.value();
  row.update_s += f.cut_s + f.load_s;
  row.cut_s += f.cut_s;
  row.find_s += f.find_s;
  row.read_back_s += f.read_back_s;
  row.filter_s += f.filter_s;
  row.pairs += f.pairs;
  row.raw += f.raw;
  row.dealt += f.dealt;
  row.most_pairs_at_once = std::max(row.most_pairs_at_once, f.most_pairs_at_once);
  add_frame(row, digest);
  return core::Done{};
}

core::Result<RaceRow> race(const std::string& stream_name, const CellSpec& cell, std::uint32_t frames,
                           std::uint32_t parts) {
  auto engine = make_broad_phase_of(cell);
  if (!engine) return engine.error();
  core::BroadPhase* broad = engine.value().broad_phase.get();
  auto made = datasets::make_box_stream(stream_name);
  if (!made) return made.error();
  datasets::BoxStream& stream = made.value();

  RaceRow row;
  row.label = label_of(cell);
  row.boxes = stream.boxes.size();
  row.remark = datasets::long_boxes_remark(stream.boxes);
  row.kind = datasets::kind_of(stream.boxes);
  const std::vector<std::uint8_t> is_static(stream.boxes.size());
  row.parts = parts;
  if (parts == 1)
    if (core::Status s = broad->load(stream.boxes, is_static); !s) return s.error();
  const std::uint32_t count = frames > 0 ? std::min(frames, stream.frames) : stream.frames;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (is_interrupted()) return pairs_interrupted();
    if (k > 0)
      if (core::Status s = stream.advance(stream.boxes); !s) return s.error();
    const core::Status s =
        parts == 1 ? run_frame(*broad, stream.boxes, row) : run_parted_frame(*broad, stream.boxes, is_static, row);
    if (!s) return s.error();
  }
  if (const auto* chooser = dynamic_cast<const core::TellsPath*>(broad)) row.path = chooser->path();
  return row;
}

nlohmann::ordered_json json_of(const datasets::BoxKind& kind) {
  // A ratio to the size of a point is infinite, which JSON cannot write.
  const double ratio = kind.size_ratio();
  return {{"boxes", kind.boxes},
          {"least_m", kind.least_m},
          {"median_m", kind.median_m},
          {"most_m", kind.most_m},
          {"size_ratio", std::isfinite(ratio) ? nlohmann::ordered_json(ratio) : nlohmann::ordered_json()},
          {"thin_share", kind.thin_share},
          {"flatness", kind.flatness},
          {"cells_of_half", kind.cells_of_half}};
}

datasets::BoxKind kind_of_json(const nlohmann::json& json) {
  return {json.at("boxes"),      json.at("least_m"),  json.at("median_m"),     json.at("most_m"),
          json.at("thin_share"), json.at("flatness"), json.at("cells_of_half")};
}

core::Result<RaceRow> row_of_json(const std::string& text) {
  try {
    const auto out = nlohmann::json::parse(text).at(0);
    RaceRow row;
    row.label = out.at("engine");
    row.frames = out.at("frames");
    row.boxes = out.at("boxes");
    row.pairs = out.at("pairs");
    row.raw = out.at("raw_pairs");
    row.digest = std::stoull(out.at("digest").get<std::string>(), nullptr, 16);
    row.update_s = out.at("update_s");
    row.find_s = out.at("find_s");
    row.filter_s = out.at("filter_s");
    row.read_back_s = out.at("read_back_s");
    row.remark = out.value("remark", "");
    row.path = out.value("path", "");
    row.parts = out.value("parts", 1U);
    row.dealt = out.value("dealt", std::uint64_t{0});
    row.cut_s = out.value("cut_s", 0.0);
    row.most_pairs_at_once = out.value("most_pairs_at_once", std::uint64_t{0});
    row.kind = kind_of_json(out.at("set"));
    return row;
  } catch (const std::exception& e) {
    return core::Error{std::string("its answer cannot be read: ") + e.what(), "child process", "",
                       core::Exit::kInternal};
  }
}

core::Result<RaceRow> race_in_child(const std::string& stream, const CellSpec& cell, std::uint32_t frames,
                                    std::uint32_t parts, const ChildLimits& limits) {
  std::vector<std::string> args{"pairs", stream};
  if (frames > 0) {
    args.emplace_back("--frames");
    args.push_back(std::to_string(frames));
  }
  if (parts > 1) {
    args.emplace_back("--parts");
    args.push_back(std::to_string(parts));
  }
  auto answer = ask_child(std::move(args), cell, limits);
  if (!answer) return answer.error();
  if (answer.value().absent.empty()) return row_of_json(answer.value().output);
  RaceRow row;
  row.label = label_of(cell);
  row.absent = std::move(answer.value().absent);
  row.verdict = std::move(answer.value().verdict);
  row.repeat = std::move(answer.value().repeat);
  return row;
}

}  // namespace

core::Result<std::vector<RaceRow>> race_boxes(const std::string& stream, const std::vector<CellSpec>& cells,
                                              std::uint32_t frames, std::uint32_t parts, const ChildLimits& limits,
                                              bool here) {
  std::vector<RaceRow> rows;
  for (const CellSpec& cell : cells) {
    const bool is_apart = !here && runs_apart(cell, limits);
    auto row = is_apart ? race_in_child(stream, cell, frames, parts, limits) : race(stream, cell, frames, parts);
    if (!row) return row.error();
    rows.push_back(std::move(row).value());
  }
  return rows;
}

std::string race_json(const std::vector<RaceRow>& rows) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const RaceRow& r : rows) {
    if (!r.absent.empty()) {
      out.push_back({{"engine", r.label}, {"absent", r.absent}, {"verdict", r.verdict}, {"repeat", r.repeat}});
      continue;
    }
    out.push_back({{"engine", r.label},
                   {"frames", r.frames},
                   {"boxes", r.boxes},
                   {"pairs", r.pairs},
                   {"raw_pairs", r.raw},
                   {"digest", fmt::format("{:#018x}", r.digest)},
                   {"update_s", r.update_s},
                   {"find_s", r.find_s},
                   {"filter_s", r.filter_s},
                   {"read_back_s", r.read_back_s},
                   {"set", json_of(r.kind)}});
    if (r.parts > 1)
      out.back().update(
          {{"parts", r.parts}, {"dealt", r.dealt}, {"cut_s", r.cut_s}, {"most_pairs_at_once", r.most_pairs_at_once}});
    if (!r.path.empty()) out.back()["path"] = r.path;
    if (!r.remark.empty()) out.back()["remark"] = r.remark;
  }
  return out.dump(2);
}

}  // namespace broadside::bench
