// Which times count. A time is a result only when there is a proof that the timed work was done right; otherwise it is
// struck out, with the reason from here.
#pragma once

#include <string>

#include "core/rows.hpp"

namespace broadside::reports {

struct Admission {
  bool is_admitted = false;
  std::string reason;  // why not; empty when admitted
  std::string caveat;  // admitted although some verdict is inconclusive: which; empty otherwise
};

// Equal in everything but names: scene digest, engine, settings, both builds and the machine.
bool same_stamp(const core::Stamp& a, const core::Stamp& b);

// Admitted when, in these rows, (1) a cell of the same stamp was recorded, (2) at least one verdict on that stamp
// passed and none failed, (3) where the engine moved the bodies itself, a law that ties motion to forces passed on a
// body that moved, because an engine that does nothing breaks few other laws, and (4) the digest of the cell's recorded
// frame at sample.final_step equals sample.final_digest, so that the timed run reached the very state that was judged.
// The reason names the first of these that does not hold.
Admission admit(const core::Sample& sample, const core::RunRows& rows);

}  // namespace broadside::reports
