// Writes a trace on a separate thread, behind a queue of bounded size in bytes. The run continues while a frame is
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

// Bytes of frames that may wait. An empty queue accepts a frame of any size.
constexpr std::size_t kQueueBytes = 256U << 20U;

// Used from one thread. If it is destroyed before finish(), it writes the waiting frames and leaves NAME.part behind,
// as TraceWriter does.
class TraceStream {
 public:
  static Result<TraceStream> create(const std::filesystem::path& path, const TraceHeader& header,
                                    std::size_t queue_bytes = kQueueBytes);

  TraceStream(TraceStream&&) noexcept;
  TraceStream& operator=(TraceStream&&) noexcept;
  ~TraceStream();

  // Waits while the queue is full. The error may come from an earlier frame; after a failure every call fails.
  Status append(FrameRecord frame);
  // Waits until everything appended so far would survive the death of this process.
  Status flush();
  // Waits for the remaining frames, then calls TraceWriter::finish().
  Status finish();

  // How often append() had to wait.
  [[nodiscard]] std::uint64_t waits() const;

 private:
  struct Impl;
  explicit TraceStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::core
