#include "core/rows.hpp"

namespace broadside::core {

std::string_view cell_state_word(CellState state) {
  switch (state) {
    case CellState::kRecorded:
      return "recorded";
    case CellState::kNotMeasured:
      return "not measured";
    case CellState::kUnsupported:
      return "unsupported";
    case CellState::kCrashed:
      return "crashed";
    case CellState::kTimedOut:
      return "timed out";
    case CellState::kInterrupted:
      return "interrupted";
    case CellState::kFailed:
      return "failed";
  }
  return "unknown";
}

}  // namespace broadside::core
