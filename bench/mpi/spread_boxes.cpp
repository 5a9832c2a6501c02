#include "bench/mpi/spread_boxes.hpp"

#include <mpi.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace broadside::bench {
namespace {

// The sample has as many boxes as core::cut_space looks at.
constexpr int kMostLookedAt = 65'536;

// A box as it is sent to another process.
struct SentBox {
  core::Box box;
  std::uint32_t id = 0;
  std::uint32_t is_static = 0;
};
static_assert(sizeof(SentBox) == 32, "it is sent as bytes");

int process_count() {
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

// The index at which each process's share begins.
std::vector<int> begins_of(const std::vector<int>& counts) {
  std::vector<int> begins(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), begins.begin(), 0);
  return begins;
}

// An MPI type of so many bytes, which is freed with this object.
class ByteType {
 public:
  explicit ByteType(int bytes) {
    MPI_Type_contiguous(bytes, MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ByteType() { MPI_Type_free(&type_); }
  ByteType(const ByteType&) = delete;
  ByteType& operator=(const ByteType&) = delete;
  [[nodiscard]] MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace

core::SpaceCut cut_over_processes(const BoxSlice& slice) {
  const int processes = process_count();
  std::vector<core::Box> own;
  const auto most = static_cast<std::size_t>(std::max(1, kMostLookedAt / processes));
  const std::size_t stride = std::max<std::size_t>(1, (slice.boxes.size() + most - 1) / most);
  for (std::size_t k = 0; k < slice.boxes.size(); k += stride) own.push_back(slice.boxes[k]);
  const auto count = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(processes));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const std::vector<int> begins = begins_of(counts);
  std::vector<core::Box> all(static_cast<std::size_t>(begins.back() + counts.back()));
  const ByteType type(static_cast<int>(sizeof(core::Box)));
  MPI_Allgatherv(own.data(), count, type.get(), all.data(), counts.data(), begins.data(), type.get(), MPI_COMM_WORLD);
  return core::cut_space(all, static_cast<std::uint32_t>(processes));
}

core::Result<core::BoxPart> exchange_boxes(const BoxSlice& slice, const core::SpaceCut& cut, std::uint64_t& sent) {
  const auto processes = static_cast<std::size_t>(process_count());
  int own = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  std::vector<std::vector<SentBox>> to(processes);
  for (std::size_t k = 0; k < slice.boxes.size(); ++k) {
    const core::Box& box = slice.boxes[k];
    // A box whose max is below its min would reach into no part and be lost.
    for (int axis = 0; axis < 3; ++axis)
      if (!(box.min[axis] <= box.max[axis]))
        return core::Error{"min is not below max", "box " + std::to_string(slice.first + k),
                           "each box needs finite min <= max"};
    const SentBox copy{box, slice.first + static_cast<std::uint32_t>(k), slice.is_static[k]};
    const std::uint32_t last = cut.part_at(box.max[cut.axis]);
    for (std::uint32_t part = cut.part_at(box.min[cut.axis]); part <= last; ++part) to[part].push_back(copy);
  }
  std::vector<int> out(processes);
  std::vector<int> in(processes);
  std::vector<SentBox> going;
  sent = 0;
  for (std::size_t k = 0; k < processes; ++k) {
    out[k] = static_cast<int>(to[k].size());
    going.insert(going.end(), to[k].begin(), to[k].end());
    if (k != static_cast<std::size_t>(own)) sent += to[k].size() * sizeof(SentBox);
    std::vector<SentBox>().swap(to[k]);
  }
  MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, MPI_COMM_WORLD);
  const std::uint64_t coming = std::accumulate(in.begin(), in.end(), std::uint64_t{0});
  // MPI counts elements in an int. All processes take part in the check, since none may leave the exchange alone.
  const std::uint64_t own_most = std::max<std::uint64_t>(coming, going.size());
  std::uint64_t most = 0;
  MPI_Allreduce(&own_most, &most, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
  if (most > 0x7FFFFFFFULL)
    return core::Error{std::to_string(most) + " boxes are more than one process can be sent",
                       "a set that is spread over processes", "start more of them", core::Exit::kMissing};
  const std::vector<int> out_begins = begins_of(out);
  const std::vector<int> in_begins = begins_of(in);
  std::vector<SentBox> there(coming);
  const ByteType type(static_cast<int>(sizeof(SentBox)));
  MPI_Alltoallv(going.data(), out.data(), out_begins.data(), type.get(), there.data(), in.data(), in_begins.data(),
                type.get(), MPI_COMM_WORLD);
  // Slices follow each other in the set, and boxes keep their order in a slice, so they arrive in the order of the set.
  core::BoxPart part;
  part.boxes.reserve(coming), part.is_static.reserve(coming), part.ids.reserve(coming);
  for (const SentBox& one : there) {
    part.boxes.push_back(one.box);
    part.is_static.push_back(static_cast<std::uint8_t>(one.is_static));
    part.ids.push_back(one.id);
  }
  return part;
}

core::Result<std::vector<core::Pair>> find_own_pairs(core::BroadPhase& broad, const core::BoxPart& part,
                                                     const core::SpaceCut& cut, std::uint32_t number) {
  if (part.boxes.empty()) return std::vector<core::Pair>{};
  if (core::Status s = broad.load(part.boxes, part.is_static); !s) return s.error();
  if (core::Status s = broad.find(); !s) return s.error();
  auto found = broad.read_back();
  if (!found) return found.error();
  std::vector<core::Pair> pairs = std::move(found).value().pairs;
  core::keep_own_pairs(cut, number, part, pairs);
  return pairs;
}

}  // namespace broadside::bench
