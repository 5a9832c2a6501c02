// Writes a trace as NAME.part and gives it its final name only when it is complete. Schema: core/trace/SCHEMA.md.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::core {

// Not thread-safe: one writer thread. A writer destroyed before finish() leaves NAME.part behind, readable up to the
// last flushed frame, and never a file under the final name.
class TraceWriter {
 public:
  // Creates path + ".part"; an existing file of the final name stays as it is until finish().
  static Result<TraceWriter> create(const std::filesystem::path& path, const TraceHeader& header);

  TraceWriter(TraceWriter&&) noexcept;
  TraceWriter& operator=(TraceWriter&&) noexcept;
  ~TraceWriter();

  // The groups in the header must be filled; others are ignored. Steps must rise.
  Status append(const FrameRecord& frame);
  // Makes everything appended so far survive the end of this process.
  Status flush();
  // Closes, syncs to disk and renames to the final name. Nothing may be appended after it.
  Status finish();

 private:
  struct Impl;
  explicit TraceWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::core
