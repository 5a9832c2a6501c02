#include "bench/box_race.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "bench/engines.hpp"
#include "datasets/box_streams/box_stream.hpp"

namespace broadside::bench {
namespace {

using Clock = std::chrono::steady_clock;

core::Status run_frame(core::BroadPhase& broad, const std::vector<core::Box>& boxes, std::uint64_t frame,
                       RaceRow& row) {
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
  row.pairs += pairs.value().pairs.size();
  row.raw += pairs.value().raw;
  // One frame's digest is that of DESIGN; further frames are told apart by their number.
  const std::uint64_t digest = core::pair_digest(pairs.value().pairs);
  row.digest += frame == 0 ? digest : core::splitmix64(digest + frame);
  ++row.frames;
  return core::Done{};
}

core::Result<RaceRow> race(const std::string& stream_name, const CellSpec& cell, std::uint32_t frames) {
  const std::string reason = why_absent(*cell.row);
  if (!reason.empty())
    return core::Error{"not measured: " + reason, std::string(cell.row->id), "leave it out", core::Exit::kMissing};
  auto settings = core::Settings::parse(cell.row->id, cell.row->settings, cell.settings);
  if (!settings) return settings.error();
  auto engine = cell.row->create(settings.value());
  if (!engine) return engine.error();
  core::BroadPhase* broad = engine.value().broad_phase.get();
  if (broad == nullptr)
    return core::Error{"it offers no broad phase with these settings", std::string(cell.row->id),
                       "see 'broadside list engines'"};
  auto made = datasets::make_box_stream(stream_name);
  if (!made) return made.error();
  datasets::BoxStream& stream = made.value();

  RaceRow row;
  const std::string short_form = settings.value().short_form();
  row.label = short_form.empty() ? std::string(cell.row->id) : std::string(cell.row->id) + "[" + short_form + "]";
  row.boxes = stream.boxes.size();
  const std::vector<std::uint8_t> is_static(stream.boxes.size());
  if (core::Status s = broad->load(stream.boxes, is_static); !s) return s.error();
  const std::uint32_t count = frames > 0 ? std::min(frames, stream.frames) : stream.frames;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (k > 0)
      if (core::Status s = stream.advance(stream.boxes); !s) return s.error();
    if (core::Status s = run_frame(*broad, stream.boxes, k, row); !s) return s.error();
  }
  return row;
}

}  // namespace

core::Result<std::vector<RaceRow>> race_boxes(const std::string& stream, const std::vector<CellSpec>& cells,
                                              std::uint32_t frames) {
  std::vector<RaceRow> rows;
  for (const CellSpec& cell : cells) {
    auto row = race(stream, cell, frames);
    if (!row) return row.error();
    rows.push_back(std::move(row).value());
  }
  return rows;
}

}  // namespace broadside::bench
