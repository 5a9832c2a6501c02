// Arrays handed over by DLPack, in both directions. The layout is that of DLPack 0.x, which every library supports.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <vector>

namespace broadside::bench::python {

// DLPack's numbers for kinds of memory.
constexpr int kHostMemory = 1;
constexpr int kCudaMemory = 2;

// An array that another library owns; valid while this object lives. Stored by rows, without gaps.
class TakenArray {
 public:
  // Error: not a capsule, a capsule that was taken before, or an array with gaps. `what` names it in the error.
  TakenArray(const pybind11::capsule& capsule, const std::string& what);
  TakenArray(const TakenArray&) = delete;
  TakenArray& operator=(const TakenArray&) = delete;
  ~TakenArray();

  [[nodiscard]] const void* data() const;
  [[nodiscard]] int memory() const;  // kHostMemory, kCudaMemory or another of DLPack's numbers
  [[nodiscard]] int device() const;
  [[nodiscard]] std::vector<std::int64_t> shape() const;
  [[nodiscard]] std::string type() const;  // "<f4" as NumPy writes it

 private:
  void* managed_ = nullptr;
};

// Where rows of 32-bit numbers lie in this library's own memory.
struct OwnRows {
  std::uint64_t address = 0;
  std::int64_t rows = 0;
  std::int64_t width = 0;
  std::int64_t row_bytes = 0;  // from one row to the next
  bool is_float = false;       // else whole numbers without a sign
};

// A capsule that another library can take once; `owner` lives as long as that library holds the rows.
pybind11::capsule given_rows(const OwnRows& rows, int memory, int device, const pybind11::object& owner);

}  // namespace broadside::bench::python
