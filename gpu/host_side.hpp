// What the host owns of a running GPU engine: its stream, and the words that the device writes into the host's memory.
#pragma once

#include "core/result.hpp"
#include "gpu/device_runtime.hpp"
#include "gpu/frame_view.hpp"

namespace broadside::gpu {

// Memory of the host that the device writes, with an owner.
class OutcomeMemory {
 public:
  OutcomeMemory() = default;
  OutcomeMemory(const OutcomeMemory&) = delete;
  OutcomeMemory& operator=(const OutcomeMemory&) = delete;
  ~OutcomeMemory() {
    if (memory_.host != nullptr) release_mapped_bytes(memory_);
  }
  core::Status allocate() {
    if (memory_.host == nullptr) {
      auto memory = allocate_mapped_bytes(sizeof(Outcome));
      if (!memory.ok()) return memory.error();
      memory_ = memory.value();
    }
    *static_cast<Outcome*>(memory_.host) = Outcome{};
    return core::Done{};
  }
  [[nodiscard]] Outcome* device() const { return static_cast<Outcome*>(memory_.device); }
  [[nodiscard]] const Outcome& operator*() const { return *static_cast<const Outcome*>(memory_.host); }

 private:
  MappedMemory memory_;
};

class Stream {
 public:
  Stream() = default;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (is_created_) release_stream(stream_);
  }
  core::Status create() {
    if (is_created_) return core::Done{};
    auto stream = create_stream();
    if (!stream.ok()) return stream.error();
    stream_ = stream.value();
    is_created_ = true;
    return core::Done{};
  }
  core::Status wait(const char* what) const { return wait_for_stream(stream_, what); }
  [[nodiscard]] StreamHandle get() const { return stream_; }

 private:
  StreamHandle stream_ = nullptr;
  bool is_created_ = false;
};

}  // namespace broadside::gpu
