// HDF5 identifiers that close themselves, and HDF5's reasons as one line. Private to core/trace/*.cpp: no public header
// includes this one.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

#include "core/result.hpp"

namespace broadside::core {

// Owns one identifier. A destructor cannot report a failed close, so callers that need the result call close().
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), closer_(other.closer_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, H5I_INVALID_HID);
      closer_ = other.closer_;
    }
    return *this;
  }
  ~Handle() { close(); }

  [[nodiscard]] hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  // True when there was nothing to close or closing succeeded.
  bool close() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id < 0 || closer_(id) >= 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

// Hold one while calling HDF5: it is a lock, because Debian builds HDF5 without thread safety, and it keeps HDF5 from
// printing. The previous settings are restored afterwards. One thread may hold several.
class QuietHdf5 {
 public:
  QuietHdf5();
  ~QuietHdf5();
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> alone_;
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// The innermost reason on HDF5's error stack, "" when the stack is empty. Empties the stack.
std::string hdf5_reason();

// `what`, followed by HDF5's reason in brackets when it gave one.
Error hdf5_error(const std::string& what, const std::string& where, const std::string& advice);

}  // namespace broadside::core
