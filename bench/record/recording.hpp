// Writes a recording run: header, frames, interrupt, progress and the finished cell.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/cell/cell_request.hpp"
#include "bench/process/progress.hpp"
#include "core/engine/counter.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"
#include "core/trace/trace_stream.hpp"

namespace broadside::bench {

class Recording {
 public:
  // With level none nothing is written, and the cell has no trace file.
  static core::Result<Recording> start(const CellRequest& request, core::TraceHeader header, std::uint64_t frames);

  // Queues the frame for the writing thread; waits while that thread is too far behind.
  core::Status add(core::FrameRecord frame);
  void note_progress(std::uint64_t done) { progress_->at(done); }
  [[nodiscard]] bool is_due(std::uint64_t step) const {
    return header_.level != core::RecordLevel::kNone && selection_.has(step);
  }

  // What the engine counted, for the finished cell's row.
  void note_work(const std::vector<core::Counter>& counters);

  // Every recording ends with exactly one of these.
  core::Result<core::Cell> finish();
  core::Result<core::Cell> interrupted();
  core::Result<core::Cell> failed(const core::Error& error);

 private:
  Recording() = default;
  core::Cell cell(core::CellState state, const std::string& reason);
  void count(const core::FrameRecord& frame);

  core::TraceHeader header_;
  std::optional<core::TraceStream> writer_;
  std::unique_ptr<Progress> progress_;
  std::string file_name_;
  StepSelection selection_;
  std::uint64_t frames_ = 0;
  std::uint64_t last_step_ = 0;
  std::uint64_t last_digest_ = 0;
  // Sums over the recorded frames of what each group holds, for the report's table of counts.
  std::map<std::string, std::uint64_t> counts_;
  std::map<std::string, std::uint64_t> work_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace broadside::bench
