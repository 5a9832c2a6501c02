#include "bench/campaign/schedulers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace broadside::bench::campaign {
namespace {

namespace fs = std::filesystem;

// Inside single quotes a shell takes everything literally except the quote itself.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// The resources that a cell needs on a node.
struct Needs {
  std::string_view name;
  bool timed;
  bool gpu;
  std::string_view slurm;
};
constexpr std::array<Needs, 4> kNeeds{{{"checked", false, false, ""},
                                       {"checked_gpu", false, true, "--gres=gpu:1"},
                                       {"timed", true, false, "--exclusive"},
                                       {"timed_gpu", true, true, "--exclusive --gres=gpu:1"}}};

bool is_timed(std::span<const ManifestCell> group) {
  return std::any_of(group.begin(), group.end(), [](const ManifestCell& c) { return c.work.repetitions > 0; });
}
bool needs_gpu(std::span<const ManifestCell> group) {
  return std::any_of(group.begin(), group.end(), [](const ManifestCell& c) { return c.needs_gpu; });
}

// One id per group, because it does the whole group.
std::vector<std::string> ids_of(const Manifest& manifest, const Needs& needs) {
  std::vector<std::string> ids;
  for (const std::span<const ManifestCell> group : groups_of(manifest))
    if (is_timed(group) == needs.timed && needs_gpu(group) == needs.gpu) ids.push_back(group.front().id);
  return ids;
}

std::string slurm(const Manifest& manifest, const fs::path& folder, const std::string& program) {
  std::string text = fmt::format(R"(#!/usr/bin/env bash
# Submits what is missing of campaign {0} as job arrays, one cell a task. Run it again after a failure.
# Options of your cluster (partition, account, time): bash slurm.sh --partition=main --time=01:00:00
# Timed cells ask for whole nodes, GPU cells for a GPU; the others share.
set -euo pipefail
folder={1}
program={2}
submit() {{
  local name=$1 needs=$2
  shift 2
  local ids=()
  while read -r id; do [[ -d $folder/cells/$id ]] || ids+=("$id"); done
  [[ ${{#ids[@]}} -gt 0 ]] || return 0
  mkdir -p "$folder/logs"
  # shellcheck disable=SC2086
  sbatch --parsable --job-name={0}-"$name" --array=0-$((${{#ids[@]}} - 1)) \
    --output="$folder/logs/%A_%a.log" $needs "$@" <<JOB
#!/usr/bin/env bash
ids=(${{ids[*]}})
exec "$program" run "$folder" --cell "\${{ids[SLURM_ARRAY_TASK_ID]}}"
JOB
}}
)",
                                 manifest.name, quoted(folder.string()), quoted(program));
  for (const Needs& needs : kNeeds) {
    const std::vector<std::string> ids = ids_of(manifest, needs);
    if (ids.empty()) continue;
    text += fmt::format("submit {} '{}' \"$@\" <<'IDS'\n", needs.name, needs.slurm);
    for (const std::string& id : ids) text += id + "\n";
    text += "IDS\n";
  }
  return text;
}

std::string parallel(const Manifest& manifest, const fs::path& folder, const std::string& program) {
  std::string text = fmt::format(R"(#!/usr/bin/env bash
# Does what is missing of campaign {0} with GNU parallel. Options go to it: bash parallel.sh --sshlogin a,b
# Timed cells run one at a time, the others on every core.
set -uo pipefail
folder={1}
program={2}
failed=0
each() {{
  local jobs=$1
  shift
  parallel --jobs "$jobs" "$@" "$program" run "$folder" --cell '{{}}' || failed=1
}}
)",
                                 manifest.name, quoted(folder.string()), quoted(program));
  for (const Needs& needs : kNeeds) {
    const std::vector<std::string> ids = ids_of(manifest, needs);
    if (ids.empty()) continue;
    text += fmt::format("each {} \"$@\" <<'IDS'\n", needs.timed || needs.gpu ? "1" : "100%");
    for (const std::string& id : ids) text += id + "\n";
    text += "IDS\n";
  }
  return text + "exit $failed\n";
}

std::string snakemake(const Manifest& manifest, const fs::path& folder, const std::string& program) {
  std::string text = fmt::format(R"(# Campaign {}: snakemake --snakefile Snakefile --cores all --keep-going
# Timed cells take every core, so that nothing runs beside them.
FOLDER = {:?}
PROGRAM = {:?}
CELLS = {{
)",
                                 manifest.name, folder.string(), program);
  for (const std::span<const ManifestCell> group : groups_of(manifest))
    text += fmt::format("    \"{}\": {{\"timed\": {}, \"gpu\": {}}},\n", group.front().id,
                        is_timed(group) ? "True" : "False", needs_gpu(group) ? 1 : 0);
  text += R"(}

rule all:
    input: expand(FOLDER + "/cells/{id}/cells.json", id=CELLS)

rule cell:
    output: FOLDER + "/cells/{id}/cells.json"
    wildcard_constraints: id="[0-9a-f]{16}"
    threads: lambda wildcards: workflow.cores if CELLS[wildcards.id]["timed"] else 1
    resources: gpu=lambda wildcards: CELLS[wildcards.id]["gpu"]
    params: program=PROGRAM, folder=FOLDER
    shell: "rmdir {params.folder}/cells/{wildcards.id} 2>/dev/null; "
           "{params.program:q} run {params.folder:q} --cell {wildcards.id}"
)";
  return text;
}

}  // namespace

const std::array<Scheduler, 3>& schedulers() {
  static constexpr std::array<Scheduler, 3> kTable{{
      {"slurm", "slurm.sh", "bash DIR/slurm.sh [SBATCH OPTION...]", slurm},
      {"parallel", "parallel.sh", "bash DIR/parallel.sh [PARALLEL OPTION...]", parallel},
      {"snakemake", "Snakefile", "snakemake --snakefile DIR/Snakefile --cores all --keep-going", snakemake},
  }};
  return kTable;
}

}  // namespace broadside::bench::campaign
