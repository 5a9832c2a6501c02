#include "core/trace/hdf5_handle.hpp"

namespace broadside::core {
namespace {

std::recursive_mutex& hdf5_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

// Called for the innermost entry first: its text is the reason, and outer entries only repeat it.
herr_t take_innermost(unsigned /*n*/, const H5E_error2_t* entry, void* reason) {
  if (entry->desc == nullptr || *entry->desc == '\0') return 0;
  *static_cast<std::string*>(reason) = entry->desc;
  return 1;
}

// A damaged file may request absurd amounts of memory, so the message must not say that the file is good.
herr_t notice_no_memory(unsigned /*n*/, const H5E_error2_t* entry, void* is_out_of_memory) {
  if (entry->maj_num == H5E_RESOURCE || entry->min_num == H5E_NOSPACE || entry->min_num == H5E_CANTALLOC)
    *static_cast<bool*>(is_out_of_memory) = true;
  return 0;
}

}  // namespace

// Every handle is closed by its owner. At exit, HDF5 1.10 would close itself once more, and after some damaged files it
// then prints "infinite loop closing library".
void never_close_at_exit() {
  static const herr_t kOnce = H5dont_atexit();
  static_cast<void>(kOnce);
}

QuietHdf5::QuietHdf5() : alone_(hdf5_mutex()) {
  never_close_at_exit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietHdf5::~QuietHdf5() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &reason);
  H5Eclear2(H5E_DEFAULT);
  for (char& c : reason)
    if (c == '\n' || c == '\r') c = ' ';
  return reason;
}

Error hdf5_error(const std::string& what, const std::string& where, const std::string& advice) {
  bool is_out_of_memory = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, notice_no_memory, &is_out_of_memory);
  const std::string reason = hdf5_reason();
  if (is_out_of_memory)
    return {what + " (out of memory: " + reason + ")", where, "more memory; where there is enough: " + advice,
            Exit::kBadInput};
  return {reason.empty() ? what : what + " (" + reason + ")", where, advice, Exit::kBadInput};
}

}  // namespace broadside::core
