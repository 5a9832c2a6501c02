// Ctrl-C and SIGTERM: asked for at frame boundaries, so that what was recorded stays readable.
#pragma once

namespace broadside::bench {

// Both set a flag from now on. A program that does not ask for it is ended after 0.6 s, one that has asked after 10 s.
void watch_for_interrupt();
bool is_interrupted();

}  // namespace broadside::bench
