// Times in the formats of other people's tools. Only admitted times are written, because those tools cannot show a time
// as struck out.
#pragma once

#include <string>

#include "core/rows.hpp"

namespace broadside::reports {

// Google Benchmark's JSON, one entry per run (its raw repetitions), so that its compare.py can apply its own U test. A
// name is SCENE/LABEL/STAGE; real_time is the mean per frame in ns. CPU time is not measured: cpu_time repeats
// real_time, and the context says so.
std::string google_benchmark_json(const core::RunRows& rows);

// github-action-benchmark's "customSmallerIsBetter": median per frame with the quartiles as range; and counters.
std::string smaller_is_better_json(const core::RunRows& rows);

// RFC 4180, one figure on each line: scene, engine, settings, machine, what, name, value, unit, runs, counts (yes, or
// why not). Struck-out times are included and marked.
std::string figures_csv(const core::RunRows& rows);

}  // namespace broadside::reports
