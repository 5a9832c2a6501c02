// Pairs of a set of boxes that is spread over processes. Space is cut into as many ranges as there are processes, and
// each process gets all boxes that reach into its range. The first process prints one JSON line.
//   mpirun -n 3 broadside_mpi_pairs BOXES [ENGINE]      e.g. boxes:uniform:1000000 octree-cpu
// The digest is that of `broadside pairs BOXES --frames 1`. Exit codes are those of broadside.
#include <mpi.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "bench/mpi/spread_boxes.hpp"
#include "bench/process/broad_phase_cell.hpp"
#include "core/pair.hpp"
#include "datasets/box_streams/box_stream.hpp"

namespace broadside::bench {
namespace {

struct Found {
  std::uint64_t boxes = 0;
  std::uint64_t dealt = 0;  // boxes of all parts together
  std::uint64_t sent = 0;   // bytes between processes
  std::uint64_t pairs = 0;
  std::uint64_t digest = 0;
  double exchange_s = 0.0;
  double find_s = 0.0;
};

// Finds the pairs of this process's part. All processes call it in the same step.
core::Status find_part(core::BroadPhase& broad, const BoxSlice& slice, int process, Found& own) {
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  const core::SpaceCut cut = cut_over_processes(slice);
  auto part = exchange_boxes(slice, cut, own.sent);
  if (!part) return part.error();
  own.exchange_s = MPI_Wtime() - start;
  own.dealt = part.value().boxes.size();
  auto pairs = find_own_pairs(broad, part.value(), cut, static_cast<std::uint32_t>(process));
  if (!pairs) return pairs.error();
  own.find_s = MPI_Wtime() - start - own.exchange_s;
  own.pairs = pairs.value().size();
  own.digest = core::pair_digest(pairs.value());
  return core::Done{};
}

// Combines the results of all processes: counts are summed, and of times the longest is taken.
Found together(const Found& own) {
  Found all = own;
  MPI_Allreduce(&own.dealt, &all.dealt, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&own.sent, &all.sent, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&own.pairs, &all.pairs, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&own.digest, &all.digest, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(&own.exchange_s, &all.exchange_s, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  MPI_Allreduce(&own.find_s, &all.find_s, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

core::Status run(const std::string& boxes, const std::string& engine_name, int process, int processes, Found& own) {
  auto cell = parse_cell_spec(engine_name);
  if (!cell) return cell.error();
  auto engine = make_broad_phase_of(cell.value());
  if (!engine) return engine.error();
  auto made = datasets::make_box_stream(boxes);
  if (!made) return made.error();
  // A generator makes the whole set; each process keeps only its slice, as though it had been given no more.
  std::vector<core::Box> all = std::move(made.value().boxes);
  own.boxes = all.size();
  const auto begin_of = [&](int k) {
    return all.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(processes);
  };
  const std::size_t first = begin_of(process);
  const std::vector<core::Box> slice(all.begin() + static_cast<std::ptrdiff_t>(first),
                                     all.begin() + static_cast<std::ptrdiff_t>(begin_of(process + 1)));
  all = {};
  const std::vector<std::uint8_t> is_static(slice.size());
  return find_part(*engine.value().broad_phase, {slice, is_static, static_cast<std::uint32_t>(first)}, process, own);
}

// Prints an error of this process and ends all processes, because others may wait for this one.
int end_all(const core::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  MPI_Abort(MPI_COMM_WORLD, static_cast<int>(error.exit));
  return static_cast<int>(error.exit);
}

}  // namespace
}  // namespace broadside::bench

int main(int count, char** given) {
  using namespace broadside;
  MPI_Init(&count, &given);
  int process = 0;
  int processes = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &process);
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  if (count != 2 && count != 3) {
    if (process == 0) std::fprintf(stderr, "usage: mpirun -n PROCESSES broadside_mpi_pairs BOXES [ENGINE]\n");
    MPI_Finalize();
    return static_cast<int>(core::Exit::kBadInput);
  }
  bench::Found own;
  const core::Status status = bench::run(given[1], count == 3 ? given[2] : "octree-cpu", process, processes, own);
  if (!status) return bench::end_all(status.error());
  const bench::Found all = bench::together(own);
  if (process == 0)
    std::printf(
        "{\"processes\": %d, \"boxes\": %llu, \"dealt\": %llu, \"bytes_between\": %llu, \"pairs\": %llu, "
        "\"digest\": \"0x%016llx\", \"exchange_s\": %.6f, \"find_s\": %.6f}\n",
        processes, static_cast<unsigned long long>(all.boxes), static_cast<unsigned long long>(all.dealt),
        static_cast<unsigned long long>(all.sent), static_cast<unsigned long long>(all.pairs),
        static_cast<unsigned long long>(all.digest), all.exchange_s, all.find_s);
  MPI_Finalize();
  return 0;
}
