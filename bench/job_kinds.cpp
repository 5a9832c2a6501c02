#include "bench/job_kinds.hpp"

#include <array>

#include "bench/paper/paper_job.hpp"

namespace broadside::bench {

// To add a kind of job: its file, and one line here.
std::span<const campaign::JobKind> job_kinds() {
  static const std::array kKinds{
      paper::paper_job_kind(),
  };
  return kKinds;
}

}  // namespace broadside::bench
