// Which search method a broad phase used, where it has more than one.
#pragma once

#include <string>

namespace broadside::core {

// Offered besides BroadPhase by engines that choose their search method from properties of the boxes.
class TellsPath {
 public:
  virtual ~TellsPath() = default;
  // The method for the boxes of the last load or update: "one tree over the boxes as they are". For people to read; no
  // code parses it.
  [[nodiscard]] virtual std::string path() const = 0;
};

}  // namespace broadside::core
