// Calls into a vendor's library: an exception becomes the one clear error that the interfaces ask for.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "core/result.hpp"

namespace broadside::reference {

// Runs call(), which returns a Result. `where` names engine and stage: "fcl-tree: find". An exception becomes an error
// with the exit code of a missing cell. Aborts are not caught here: references run in a child process for that.
template <typename Call>
auto vendor_call(std::string_view where, Call&& call) -> decltype(call()) {
  try {
    return std::forward<Call>(call)();
  } catch (const std::bad_alloc&) {
    return core::Error{"out of memory", std::string(where), "run a smaller scene", core::Exit::kMissing};
  } catch (const std::exception& e) {
    return core::Error{std::string("the library threw: ") + e.what(), std::string(where),
                       "see the engine's known defects in reference/README.md", core::Exit::kMissing};
  } catch (...) {
    return core::Error{"the library threw something that is no std::exception", std::string(where),
                       "see the engine's known defects in reference/README.md", core::Exit::kMissing};
  }
}

}  // namespace broadside::reference
