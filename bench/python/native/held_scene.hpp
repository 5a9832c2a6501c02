// A scene that Python objects share.
#pragma once

#include <memory>

#include "core/scene/scene.hpp"

namespace broadside::bench::python {

// Immutable: arrays over its bodies and meshes stay valid while one of them holds it.
struct HeldScene {
  std::shared_ptr<const core::Scene> scene;
};

}  // namespace broadside::bench::python
