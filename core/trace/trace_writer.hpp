// Writes a trace as NAME.part and gives it its final name only when it is complete. Schema: core/trace/SCHEMA.md.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::core {

// Not thread-safe: one writer thread (core/trace/trace_stream.hpp has one). A writer destroyed before finish() leaves
// NAME.part behind, readable up to the last flushed frame, and never a file under the final name.
class TraceWriter {
 public:
  // Creates path + ".part"; an existing file of the final name is not changed until finish().
  static Result<TraceWriter> create(const std::filesystem::path& path, const TraceHeader& header);

  TraceWriter(TraceWriter&&) noexcept;
  TraceWriter& operator=(TraceWriter&&) noexcept;
  ~TraceWriter();

  // The groups in the header must be filled; others are ignored. Steps must increase.
  Status append(const FrameRecord& frame);
  // When late, frames that fill whole chunks are written uncompressed: larger, and several times faster.
  void hurry(bool is_late);
  // Makes everything appended so far survive the death of this process.
  Status flush();
  // Flushes when a flush is due, a second after the last one. append() checks this too, so only a writer that waits for
  // frames needs to call it.
  Status flush_if_due();
  // Closes, syncs to disk and renames to the final name. Nothing may be appended after it.
  Status finish();

 private:
  struct Impl;
  explicit TraceWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::core
