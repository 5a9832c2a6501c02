#include "validation/judge.hpp"

namespace broadside::validation {
namespace {

FrameSource source_of(const core::TraceReader& trace) {
  return {trace.header(), trace.steps(),
          [&trace](std::uint64_t index, std::uint32_t groups) { return trace.read(index, groups); }};
}

}  // namespace

core::Result<std::vector<core::Verdict>> judge(const core::TraceReader& trace, const core::TraceReader* baseline,
                                               const JudgeOptions& options) {
  const FrameSource subject = source_of(trace);
  if (baseline == nullptr) return judge(subject, nullptr, options);
  const FrameSource other = source_of(*baseline);
  return judge(subject, &other, options);
}

}  // namespace broadside::validation
