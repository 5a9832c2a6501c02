// One or two cubes of 1 m with a closed-form motion, which two_body_scenes_test.cpp derives.
#pragma once

#include "core/scene/scene.hpp"

namespace broadside::datasets {

core::Scene head_on();
core::Scene unequal();
core::Scene glancing();
core::Scene oblique();
core::Scene slide();
core::Scene rest();
core::Scene resting();
core::Scene stack();
core::Scene apart();

}  // namespace broadside::datasets
