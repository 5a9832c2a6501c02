// Reads a trace frame by frame. Schema: core/trace/SCHEMA.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/statistics.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::core {

// Not thread-safe. Does not trust the file: types, shapes, offsets and indices are checked before use.
class TraceReader {
 public:
  // A file that is not a trace, is of a later version, or lacks a required part is an error that says so. A .part file
  // can be opened too, with the frames that were flushed.
  static Result<TraceReader> open(const std::filesystem::path& path);

  TraceReader(TraceReader&&) noexcept;
  TraceReader& operator=(TraceReader&&) noexcept;
  ~TraceReader();

  [[nodiscard]] const TraceHeader& header() const;
  [[nodiscard]] const std::filesystem::path& path() const;
  [[nodiscard]] std::uint64_t frame_count() const;
  // More than frame_count() when the writer was interrupted: some frames are only partly in the file.
  [[nodiscard]] std::uint64_t frames_begun() const;
  // Step of each recorded frame, rising.
  [[nodiscard]] const std::vector<std::uint64_t>& steps() const;
  [[nodiscard]] const std::vector<std::uint64_t>& digests() const;
  // Random access by index 0 .. frame_count()-1; reads only the requested groups that the trace has.
  Result<FrameRecord> read(std::uint64_t index, std::uint32_t groups) const;
  // The rows that the writer made every 100 steps, METHOD 9; empty without contacts.
  Result<std::vector<PenetrationStatistics>> statistics() const;

 private:
  struct Impl;
  explicit TraceReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::core
