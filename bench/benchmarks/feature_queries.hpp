// First touch of vertices and faces, and of edges, by each engine that answers such queries, on the same random
// motions of three kinds: anywhere (few touch), near (all are near enough to be candidates of a broad phase) and
// touching; and on candidates of two moving surfaces, folding-sheet and moving-heap. A rate counts when our own engine
// was neither late nor missed a touch on them; what others miss is a counter beside their rate.
#pragma once

namespace broadside::bench {

// Adds "first-touch/KIND/WHICH/ENGINE" to the suites.
void register_feature_queries();

}  // namespace broadside::bench
