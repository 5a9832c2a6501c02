#include "bench/python/native/dlpack.hpp"

#include <memory>

#include "bench/python/native/raise.hpp"

namespace py = pybind11;

namespace broadside::bench::python {
namespace {

// The names and the order of members are DLPack's own: they are its binary interface.
struct DLDevice {
  std::int32_t device_type;
  std::int32_t device_id;
};
struct DLDataType {
  std::uint8_t code;  // 0 signed, 1 unsigned, 2 floating point
  std::uint8_t bits;
  std::uint16_t lanes;
};
struct DLTensor {
  void* data;
  DLDevice device;
  std::int32_t ndim;
  DLDataType dtype;
  std::int64_t* shape;
  std::int64_t* strides;  // in elements; null = by rows, without gaps
  std::uint64_t byte_offset;
};
struct DLManagedTensor {
  DLTensor dl_tensor;
  void* manager_ctx;
  void (*deleter)(DLManagedTensor*);
};
static_assert(sizeof(DLManagedTensor) == 64, "the layout that every library of a 64-bit system has");

constexpr const char* kName = "dltensor";
constexpr const char* kTaken = "used_dltensor";

const DLTensor& tensor(void* managed) {
  return static_cast<DLManagedTensor*>(managed)->dl_tensor;
}

bool has_gaps(const DLTensor& t) {
  if (t.strides == nullptr) return false;
  std::int64_t stride = 1;
  for (int k = t.ndim - 1; k >= 0; --k) {
    if (t.shape[k] > 1 && t.strides[k] != stride) return true;
    stride *= t.shape[k];
  }
  return false;
}

// What a capsule that this module gave out keeps alive.
struct GivenRows {
  DLManagedTensor managed{};
  std::int64_t shape[2] = {};
  std::int64_t strides[2] = {};
  py::object owner;
};

// Called by the library that took the rows, perhaps from a thread without Python's lock.
void release(DLManagedTensor* managed) {
  const py::gil_scoped_acquire lock;
  delete static_cast<GivenRows*>(managed->manager_ctx);
}

// Destroys a capsule that no library took.
void drop(PyObject* capsule) {
  if (PyCapsule_IsValid(capsule, kName) == 0) return;
  auto* managed = static_cast<DLManagedTensor*>(PyCapsule_GetPointer(capsule, kName));
  managed->deleter(managed);
}

}  // namespace

TakenArray::TakenArray(const py::capsule& capsule, const std::string& what) {
  if (PyCapsule_IsValid(capsule.ptr(), kName) == 0)
    throw Raised({"it is no capsule of DLPack, or was taken before", what, "give the array itself"});
  void* const managed = PyCapsule_GetPointer(capsule.ptr(), kName);
  if (has_gaps(tensor(managed)))
    throw Raised({"its rows have gaps", what, "pack it on its device, such as cupy.ascontiguousarray(x)"});
  PyCapsule_SetName(capsule.ptr(), kTaken);
  managed_ = managed;
}

TakenArray::~TakenArray() {
  auto* managed = static_cast<DLManagedTensor*>(managed_);
  if (managed != nullptr && managed->deleter != nullptr) managed->deleter(managed);
}

const void* TakenArray::data() const {
  return static_cast<const char*>(tensor(managed_).data) + tensor(managed_).byte_offset;
}
int TakenArray::memory() const {
  return tensor(managed_).device.device_type;
}
int TakenArray::device() const {
  return tensor(managed_).device.device_id;
}
std::vector<std::int64_t> TakenArray::shape() const {
  const DLTensor& t = tensor(managed_);
  return {t.shape, t.shape + t.ndim};
}

std::string TakenArray::type() const {
  const DLDataType& type = tensor(managed_).dtype;
  constexpr char kCodes[] = "iuf";
  if (type.code > 2 || type.lanes != 1) return "another type";
  return "<" + std::string(1, kCodes[type.code]) + std::to_string(type.bits / 8);
}

py::capsule given_rows(const OwnRows& rows, int memory, int device, const py::object& owner) {
  auto given = std::make_unique<GivenRows>();
  given->shape[0] = rows.rows;
  given->shape[1] = rows.width;
  given->strides[0] = rows.row_bytes / static_cast<std::int64_t>(sizeof(float));
  given->strides[1] = 1;
  given->owner = owner;
  DLTensor& t = given->managed.dl_tensor;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): Python has addresses as integers
  t.data = reinterpret_cast<void*>(rows.address);
  t.device = {memory, device};
  t.ndim = 2;
  t.dtype = {static_cast<std::uint8_t>(rows.is_float ? 2 : 1), 32, 1};
  t.shape = given->shape;
  t.strides = given->strides;
  given->managed.manager_ctx = given.get();
  given->managed.deleter = release;
  PyObject* const capsule = PyCapsule_New(&given->managed, kName, drop);
  if (capsule == nullptr) throw py::error_already_set();
  static_cast<void>(given.release());  // the capsule's, or that of the library that takes it
  return py::reinterpret_steal<py::capsule>(capsule);
}

}  // namespace broadside::bench::python
