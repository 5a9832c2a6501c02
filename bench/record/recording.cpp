#include "bench/record/recording.hpp"

#include <fmt/format.h>

#include <utility>

namespace broadside::bench {

core::Result<Recording> Recording::start(const CellRequest& request, core::TraceHeader header, std::uint64_t frames) {
  Recording r;
  r.selection_ = request.selection;
  r.start_ = std::chrono::steady_clock::now();
  r.progress_ = std::make_unique<Progress>(header.stamp.label(), frames);
  if (request.level != core::RecordLevel::kNone) {
    r.file_name_ = trace_file_name(header.stamp);
    auto writer = core::TraceStream::create(request.folder / r.file_name_, header);
    if (!writer) return writer.error();
    r.writer_ = std::move(writer).value();
  }
  r.header_ = std::move(header);
  return r;
}

core::Status Recording::add(core::FrameRecord frame) {
  last_step_ = frame.step;
  last_digest_ = frame.digest;
  // Without a trace only the last frame is recorded, for its digest.
  frames_ = header_.level == core::RecordLevel::kNone ? frame.step : frames_ + 1;
  count(frame);
  if (writer_) {
    if (core::Status s = writer_->append(std::move(frame)); !s) return s;
  }
  return core::Done{};
}

void Recording::count(const core::FrameRecord& frame) {
  const auto has = [&](core::Group g) { return (header_.groups & bit(g)) != 0; };
  if (has(core::Group::kPairs)) {
    counts_["pairs: candidates, mean"] += frame.pairs.size();
    counts_["pairs: raw, mean"] += frame.pairs_raw;
  }
  if (has(core::Group::kConfirmed)) {
    counts_["pairs: confirmed, mean"] += frame.confirmed.size();
    for (const core::Proximity& p : frame.proximity) counts_["pairs: touching, mean"] += p.is_touching() ? 1 : 0;
  }
  if (has(core::Group::kContacts)) counts_["pairs: contacts, mean"] += frame.contacts.size();
  if (has(core::Group::kNarrow)) counts_["pairs: measured, mean"] += frame.measured.size();
}

void Recording::note_work(const std::vector<core::Counter>& counters) {
  for (const core::Counter& counter : counters) work_[std::string(counter.name)] = counter.count;
}

core::Cell Recording::cell(core::CellState state, const std::string& reason) {
  core::Cell cell;
  cell.stamp = header_.stamp;
  cell.state = state;
  cell.reason = reason;
  cell.frames = frames_;
  cell.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (frames_ > 0) cell.digests[last_step_] = last_digest_;
  cell.notes = header_.notes;
  for (const auto& [what, sum] : counts_)
    cell.notes[what] = fmt::format("{:.4g}", static_cast<double>(sum) / static_cast<double>(frames_));
  cell.counters = work_;
  // The count of raw pairs measures the work of the engine's own filter; the other pairs are its answers.
  if (const auto raw = counts_.find("pairs: raw, mean"); raw != counts_.end()) cell.counters["raw pairs"] = raw->second;
  progress_.reset();
  return cell;
}

core::Result<core::Cell> Recording::finish() {
  if (writer_) {
    if (core::Status s = writer_->finish(); !s) return s.error();
  }
  core::Cell done = cell(core::CellState::kRecorded, "");
  done.trace_file = file_name_;
  return done;
}

core::Result<core::Cell> Recording::interrupted() {
  core::Cell stopped = cell(core::CellState::kInterrupted, "interrupted after frame " + std::to_string(last_step_));
  if (writer_) {
    if (core::Status s = writer_->flush(); !s) return s.error();
    stopped.trace_file = file_name_ + ".part";
  }
  return stopped;
}

core::Result<core::Cell> Recording::failed(const core::Error& error) {
  core::Cell broken = cell(core::CellState::kFailed, error.line());
  if (writer_) {
    if (core::Status s = writer_->flush(); !s) return s.error();
    broken.trace_file = file_name_ + ".part";
  }
  return broken;
}

}  // namespace broadside::bench
