// What the engines with the stages of RIGID 8 declare of themselves where bodies turn.
#pragma once

#include <string_view>

#include "core/engine/declaration.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/swept_bodies.hpp"

namespace broadside::core {

// What holds in the steps of this scene. twin_of: empty, or the engine whose bits this one repeats.
Declaration rigid_declaration(const SoftSettings& solver, const Scene& scene, Swept swept,
                              std::string_view twin_of = {});

// The same where bodies sleep (core/method/rigid/sleep.hpp): a body slower than this may be stopped. 0 = bodies never
// sleep.
Declaration with_sleep(const Declaration& declaration, float sleep_speed_m_s);

}  // namespace broadside::core
