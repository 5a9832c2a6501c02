// The ratio of two sets of measured times, with its uncertainty: a hierarchical bootstrap.
#pragma once

#include <cstdint>
#include <vector>

namespace broadside::reports {

// One time (s) for each run of one process, in order. Processes and runs are both random samples, because processes
// differ by more than runs of one process. The frames of a run are not: they are the same work in the same order.
using ProcessRuns = std::vector<double>;

struct RatioInterval {
  double estimate = 0.0;         // head / base
  double low = 0.0, high = 0.0;  // 95 % for one look: 2.5 % of the resamples lie beyond each
  // The probability of so large (or small) a ratio if the true one were 1 + delta (or 1 / (1 + delta)); one-sided, and
  // never below the smallest p that this number of processes can show.
  double p_slower = 1.0, p_faster = 1.0;
};

// Draws processes with replacement, and of each drawn process its runs with replacement; a process counts by the median
// of its runs, a side by the median of its processes (Davison and Hinkley 1997, section 3.8; Efron 1979 for the
// percentile interval). Deterministic: the same figures give the same interval. Neither side may be empty, no process
// without runs.
// looks, at least 1: how often the figures are evaluated while measuring goes on. Each look gets its share of the 5 %
// (Bonferroni), so that looking more often does not find more by chance.
RatioInterval ratio_interval(const std::vector<ProcessRuns>& base, const std::vector<ProcessRuns>& head, double delta,
                             std::uint32_t looks = 1);

// The same for processes that ran in turns, one of the base and one of the head. A pair holds, run by run, the ratio of
// head over base (frame_ratio). Pairs are drawn, and in each pair its runs; the median of the pairs is the estimate. A
// drift that is slower than a pair of frames cancels in each ratio.
RatioInterval paired_interval(const std::vector<ProcessRuns>& pairs, double delta, std::uint32_t looks = 1);

// The smallest p that so many processes can give. If the builds were equal, all processes of one would be slower than
// all of the other by chance in one of C(base + head, base) orders; all n pairs would have one sign in one of 2^n
// cases. Below 0.025 from 4 and 4 processes, or from 6 pairs.
double smallest_p(std::uint64_t base, std::uint64_t head, bool is_paired);

// Which of many tests are significant together: true where the p-value is among those that the procedure of Benjamini
// and Hochberg (1995) rejects at the false discovery rate q. In the given order.
std::vector<bool> benjamini_hochberg(const std::vector<double>& p_values, double q);

}  // namespace broadside::reports
