// Boxes frame by frame in an HDF5 file: a box stream. Schema: core/trace/SCHEMA.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::core {

// Not thread-safe. Checks shapes and types, not the boxes themselves.
class BoxFile {
 public:
  // Opens a file with the dataset /boxes, [frames, n, 6] or [n, 6] f32; otherwise a trace, whose detection boxes are
  // read. Errors: a file that is missing, is not HDF5, is neither of the two, has another shape or type, or has no
  // frame.
  static Result<BoxFile> open(const std::filesystem::path& path);

  BoxFile(BoxFile&&) noexcept;
  BoxFile& operator=(BoxFile&&) noexcept;
  ~BoxFile();

  [[nodiscard]] std::uint64_t frames() const;
  // frame: 0 ... frames() - 1.
  Result<std::vector<Box>> read(std::uint64_t frame);

 private:
  struct Impl;
  explicit BoxFile(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// Gives the boxes of the next frame; every frame has the same number of boxes.
using NextBoxes = std::function<Result<std::vector<Box>>()>;

// Writes `frames` frames as /boxes [frames, n, 6]; `next` is called once per frame, in order. The file appears complete
// under its name or not at all. Errors: those of `next`; the file cannot be written (folder, permission, space).
Status write_box_file(const std::filesystem::path& path, std::uint64_t frames, const NextBoxes& next);

}  // namespace broadside::core
