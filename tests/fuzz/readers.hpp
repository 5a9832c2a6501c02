// The readers of untrusted files, each as a function of bytes. The fuzzers call them, and so does the ordinary test of
// the kept inputs. Each must return, whatever the bytes are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "bench/campaign/manifest.hpp"
#include "core/engine/narrow_phase.hpp"
#include "core/mesh/load_mesh.hpp"
#include "core/plugin/program_protocol.hpp"
#include "core/trace/trace_reader.hpp"
#include "datasets/box_streams/raw_boxes.hpp"
#include "datasets/scene_file/scene_file.hpp"

namespace broadside::fuzz {

// A folder of this process for the file that is read next; it is removed at the end.
class Scratch {
 public:
  Scratch() {
    std::error_code failed;
    const bool has_memory = std::filesystem::is_directory("/dev/shm", failed);
    std::string pattern = (std::filesystem::path(has_memory ? "/dev/shm" : std::filesystem::temp_directory_path()) /
                           "broadside-fuzz-XXXXXX")
                              .string();
    path_ = mkdtemp(pattern.data());
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path file(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    const std::filesystem::path path = path_ / name;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path;
  }

 private:
  std::filesystem::path path_;
};

inline const Scratch& scratch() {
  static const Scratch folder;
  return folder;
}

// A refusal is one line that says where and what to do.
inline void check_refusal(const core::Error& error) {
  if (error.what.empty() || error.line().find('\n') != std::string::npos) __builtin_trap();
}

// A scene file may ask for ten million bodies, and to make them takes long without being a fault. So inputs with a
// whole number of more than three digits are skipped.
inline bool asks_for_much(std::string_view text) {
  std::size_t run = 0;
  for (const char c : text) {
    const bool is_digit = (c >= '0' && c <= '9') || c == '_';
    run = is_digit ? run + 1 : 0;
    if (run > 3) return true;
  }
  return text.find("0x") != std::string_view::npos;
}

inline void read_scene(const std::uint8_t* data, std::size_t size) {
  if (asks_for_much({reinterpret_cast<const char*>(data), size})) return;
  const auto path = scratch().file("input.toml", data, size);
  const auto scene = datasets::read_scene_file(path, datasets::SceneOptions{.meshes = {}, .frames = {}, .seed = {}});
  if (!scene) return check_refusal(scene.error());
  if (!core::check_scene(scene.value())) __builtin_trap();
}

inline void read_boxes(const std::uint8_t* data, std::size_t size) {
  const auto boxes = datasets::read_raw_boxes(scratch().file("input.boxes", data, size));
  if (!boxes) return check_refusal(boxes.error());
  if (boxes.value().size() * sizeof(core::Box) + 4 != size) __builtin_trap();
}

inline void read_trace(const std::uint8_t* data, std::size_t size) {
  const auto trace = core::TraceReader::open(scratch().file("input.h5", data, size));
  if (!trace) return check_refusal(trace.error());
  constexpr std::uint64_t kFrames = 16;
  for (std::uint64_t k = 0; k < trace.value().frame_count() && k < kFrames; ++k)
    if (const auto frame = trace.value().read(k, ~0U); !frame) return check_refusal(frame.error());
  if (const auto rows = trace.value().statistics(); !rows) check_refusal(rows.error());
}

// The first byte says which format the rest is.
inline void read_mesh(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array<const char*, 6> kNames{"input.ply", "input.obj",  "input.stl",
                                                     "input.off", "input.gltf", "input.glb"};
  if (size == 0) return;
  const auto path = scratch().file(kNames[data[0] % kNames.size()], data + 1, size - 1);
  const auto mesh = core::load_mesh(path);
  if (!mesh) return check_refusal(mesh.error());
  if (mesh.value().mesh.triangles.empty()) __builtin_trap();
}

template <typename Row>
void read_program_rows(std::span<const std::byte> payload, std::uint64_t capacity) {
  const auto answered = core::read_rows_answer<Row>(payload, capacity);
  if (!answered) return check_refusal(answered.error());
  if (answered.value().rows.size() != std::min(answered.value().demanded, capacity)) __builtin_trap();
}

// An answer of a program engine. The first byte says to which call, the second how much room there was for rows.
inline void read_program(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return;
  const std::uint64_t capacity = data[1];
  const auto answer = std::as_bytes(std::span(data, size)).subspan(2);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!core::is_plain_text(core::shown_text(text))) __builtin_trap();
  if (answer.size() < 8) return;
  const auto head = core::read_answer_head(answer.first<8>(), core::kMostHelloBytes);
  if (!head) return check_refusal(head.error());
  const auto payload = answer.subspan(8);
  switch (data[0] % 6) {
    case 0: {
      const auto hello = core::read_hello(payload);
      if (!hello) return check_refusal(hello.error());
      if (!(hello.value().margin_m >= 0.0)) __builtin_trap();
      return;
    }
    case 1:
      return read_program_rows<broadside_state2>(payload, capacity);
    case 2:
      return read_program_rows<broadside_point>(payload, capacity);
    case 3:
      return read_program_rows<broadside_contact>(payload, capacity);
    case 4:
      return read_program_rows<broadside_detection>(payload, capacity);
    default:
      return read_program_rows<broadside_pair>(payload, capacity);
  }
}

// The manifest of a campaign. What is read must not be able to run without end.
inline void read_manifest(const std::uint8_t* data, std::size_t size) {
  const auto file = scratch().file("manifest.json", data, size);
  const auto manifest = bench::campaign::read_manifest(file.parent_path());
  if (!manifest) return check_refusal(manifest.error());
  std::size_t cells = 0;
  for (const auto& group : bench::campaign::groups_of(manifest.value())) cells += group.size();
  if (cells != manifest.value().cells.size()) __builtin_trap();
  for (const auto& cell : manifest.value().cells) {
    if (cell.id.size() != 16 || cell.id.find('/') != std::string::npos) __builtin_trap();  // it names a folder
    if (!(cell.work.time_limit_s > 0.0 && std::isfinite(cell.work.time_limit_s))) __builtin_trap();
    if (cell.work.processes < 1) __builtin_trap();
  }
}

struct Reader {
  std::string_view name;  // of its fuzzer and of its folder in corpus/
  void (*read)(const std::uint8_t* data, std::size_t size);
};
inline constexpr std::array<Reader, 6> kReaders{{{"scene", read_scene},
                                                 {"boxes", read_boxes},
                                                 {"trace", read_trace},
                                                 {"mesh", read_mesh},
                                                 {"program", read_program},
                                                 {"manifest", read_manifest}}};

}  // namespace broadside::fuzz
