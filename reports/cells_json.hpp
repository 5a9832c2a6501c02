// Cells for machines: what 'run --json' prints.
#pragma once

#include <string>
#include <vector>

#include "core/rows.hpp"

namespace broadside::reports {

// {"format": "broadside-run", "version": 1, "cells": [{scene, engine, settings, label, state, reason, frames, wall_s,
// trace, last_step, last_digest, counters}, ...]}; digests as "0x" and 16 digits.
std::string cells_json(const std::vector<core::Cell>& cells);

}  // namespace broadside::reports
