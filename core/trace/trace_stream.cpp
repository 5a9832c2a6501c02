#include "core/trace/trace_stream.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/trace/columns.hpp"
#include "core/trace/trace_writer.hpp"

namespace broadside::core {
namespace {

// How often the writer checks, without being woken, for waiting frames and for a flush that is due. Much shorter than
// the time between two flushes, which bounds what a kill may lose.
constexpr std::chrono::milliseconds kIdle{25};
// The writer is woken when this many bytes wait. Waking a thread takes longer than queueing a frame that has only a
// digest, and the run would pay for it in every frame.
constexpr std::size_t kWorthWaking = 256U << 10U;

std::size_t bytes_of(const FrameRecord& frame) {
  std::size_t sum = sizeof frame;
  for (const Column& c : columns()) {
    if (c.layout != Layout::kFrameBodies && c.layout != Layout::kRows) continue;
    sum += records_of(frame, c.records).count * row_bytes(c);
  }
  return sum;
}

}  // namespace

struct TraceStream::Impl {
  struct Waiting {
    FrameRecord frame;
    std::size_t bytes;
  };

  explicit Impl(TraceWriter w, std::size_t limit) : writer(std::move(w)), queue_bytes(limit) {
    thread = std::thread([this] { write_frames(); });
  }
  ~Impl() { end(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Runs on the writer's thread.
  void write_frames() {
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait_for(lock, kIdle, [this] { return is_awake(); });
      if (queue.empty()) {
        if (is_ending) return;
        is_busy = true;
        lock.unlock();
        const Status s = writer.flush_if_due();
        lock.lock();
        is_busy = false;
        note(s);
      }
      while (!queue.empty()) write_front(lock);
    }
  }

  // The frame stays in the queue while it is written, so its bytes still count.
  void write_front(std::unique_lock<std::mutex>& lock) {
    writer.hurry(waiting_bytes > queue_bytes / 2);
    const FrameRecord& frame = queue.front().frame;  // its address stays valid while frames are queued behind it
    lock.unlock();
    const Status s = error ? Status(*error) : writer.append(frame);
    lock.lock();
    note(s);
    waiting_bytes -= queue.front().bytes;
    queue.pop_front();
    changed.notify_all();
  }

  // Whether the writer should write the queued frames now.
  [[nodiscard]] bool is_awake() const {
    return is_ending || (!queue.empty() && (is_awaited || waiting_bytes >= kWorthWaking));
  }

  // Used by callers that wait for the writer.
  template <typename Condition>
  void await(std::unique_lock<std::mutex>& lock, const Condition& condition) {
    is_awaited = true;
    changed.notify_all();
    changed.wait(lock, condition);
    is_awaited = false;
  }

  void note(const Status& s) {
    if (!s && !error) error = s.error();
    changed.notify_all();
  }

  Status append(FrameRecord frame) {
    const std::size_t bytes = bytes_of(frame);
    std::unique_lock lock(mutex);
    const auto has_room = [&] { return error || queue.empty() || waiting_bytes + bytes <= queue_bytes; };
    if (!has_room()) {
      ++waits;
      await(lock, has_room);
    }
    if (error) return *error;
    waiting_bytes += bytes;
    queue.push_back({std::move(frame), bytes});
    if (is_awake()) changed.notify_all();
    return Done{};
  }

  // Waits until the thread has nothing left; then this thread may use the writer.
  Status drain(std::unique_lock<std::mutex>& lock) {
    await(lock, [this] { return queue.empty() && !is_busy; });
    if (error) return *error;
    return Done{};
  }

  void end() {
    {
      const std::lock_guard lock(mutex);
      is_ending = true;
    }
    changed.notify_all();
    if (thread.joinable()) thread.join();
  }

  TraceWriter writer;
  std::size_t queue_bytes;
  std::mutex mutex;
  std::condition_variable changed;
  // Guarded by the mutex; only the thread uses the front. error is set once.
  std::deque<Waiting> queue;
  std::size_t waiting_bytes = 0;
  bool is_busy = false;
  bool is_ending = false;
  bool is_awaited = false;
  std::optional<Error> error;
  std::uint64_t waits = 0;
  std::thread thread;
};

TraceStream::TraceStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TraceStream::TraceStream(TraceStream&&) noexcept = default;
TraceStream& TraceStream::operator=(TraceStream&&) noexcept = default;
TraceStream::~TraceStream() = default;

Result<TraceStream> TraceStream::create(const std::filesystem::path& path, const TraceHeader& header,
                                        std::size_t queue_bytes) {
  Result<TraceWriter> writer = TraceWriter::create(path, header);
  if (!writer) return writer.error();
  return TraceStream(std::make_unique<Impl>(std::move(writer).value(), queue_bytes));
}

Status TraceStream::append(FrameRecord frame) {
  return impl_->append(std::move(frame));
}

Status TraceStream::flush() {
  std::unique_lock lock(impl_->mutex);
  if (Status s = impl_->drain(lock); !s) return s;
  return impl_->writer.flush();
}

Status TraceStream::finish() {
  impl_->end();
  if (impl_->error) return *impl_->error;
  return impl_->writer.finish();
}

std::uint64_t TraceStream::waits() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->waits;
}

}  // namespace broadside::core
