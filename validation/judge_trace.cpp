#include <utility>

#include "validation/judge.hpp"

namespace broadside::validation {
namespace {

core::Result<FrameSource> source_of(const core::TraceReader& trace) {
  auto statistics = trace.statistics();
  if (!statistics) return statistics.error();
  return FrameSource{trace.header(), trace.steps(),
                     [&trace](std::uint64_t index, std::uint32_t groups) { return trace.read(index, groups); },
                     std::move(statistics).value(), trace.path().extension() == ".part"};
}

}  // namespace

core::Result<std::vector<core::Verdict>> judge(const core::TraceReader& trace, const core::TraceReader* baseline,
                                               const JudgeOptions& options) {
  const auto subject = source_of(trace);
  if (!subject) return subject.error();
  if (baseline == nullptr) return judge(subject.value(), nullptr, options);
  const auto other = source_of(*baseline);
  if (!other) return other.error();
  return judge(subject.value(), &other.value(), options);
}

}  // namespace broadside::validation
