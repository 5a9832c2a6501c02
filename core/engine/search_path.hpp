// Which way a broad phase took, where it has more than one.
#pragma once

#include <string>

namespace broadside::core {

// Offered beside BroadPhase by engines that choose how they search by what the boxes are like.
class TellsPath {
 public:
  virtual ~TellsPath() = default;
  // Of the boxes of the last load or update: "one tree over the boxes as they are". For people; nothing reads it.
  [[nodiscard]] virtual std::string path() const = 0;
};

}  // namespace broadside::core
