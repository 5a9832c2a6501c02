// Ctrl-C: asked for at frame boundaries, so that what was recorded stays readable.
#pragma once

namespace broadside::bench {

// SIGINT and SIGTERM set a flag from now on; a second one ends the program at once.
void watch_for_interrupt();
bool is_interrupted();

}  // namespace broadside::bench
