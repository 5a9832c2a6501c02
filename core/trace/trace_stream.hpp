// Writes a trace on a thread of its own, behind a queue that is bounded in bytes. The run goes on while a frame is
// packed and written; when the disk is slower than the run, the run waits and no frame is lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "core/trace/trace_header.hpp"

namespace broadside::core {

// Frames that may wait. One frame of any size may always be on its way.
constexpr std::size_t kQueueBytes = 256U << 20U;

// Used from one thread. Destroyed before finish(), it writes what waits and leaves NAME.part behind, as TraceWriter
// does.
class TraceStream {
 public:
  static Result<TraceStream> create(const std::filesystem::path& path, const TraceHeader& header,
                                    std::size_t queue_bytes = kQueueBytes);

  TraceStream(TraceStream&&) noexcept;
  TraceStream& operator=(TraceStream&&) noexcept;
  ~TraceStream();

  // Waits while the queue is full. The error may be that of an earlier frame; once failed it stays failed.
  Status append(FrameRecord frame);
  // Waits until everything appended so far would survive the end of this process.
  Status flush();
  // Waits for the rest, then TraceWriter::finish().
  Status finish();

  // How often append() had to wait.
  [[nodiscard]] std::uint64_t waits() const;

 private:
  struct Impl;
  explicit TraceStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::core
