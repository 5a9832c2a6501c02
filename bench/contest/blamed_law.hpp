// Which broken laws of the contest a known cause explains.
#pragma once

#include <string_view>

namespace broadside::bench::contest {

struct BlamedLaw {
  std::string_view engine;  // how labels begin; empty = any
  std::string_view law;
  std::string_view scene;  // how names begin; empty = any

  [[nodiscard]] bool covers(std::string_view label, std::string_view broken, std::string_view scene_name) const {
    return label.starts_with(engine) && broken == law && scene_name.starts_with(scene);
  }
};

}  // namespace broadside::bench::contest
