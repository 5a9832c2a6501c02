// Times the first touch of vertices and faces, and of edges, by each engine that answers such queries. All engines get
// the same random motions of three kinds: anywhere (few touch), near (all are near enough to be candidates of a broad
// phase) and touching; and candidates of two moving surfaces, folding-sheet and moving-heap. A rate counts when our own
// engine was neither late nor missed a touch on these queries. The touches that other engines miss are a counter beside
// their rate.
#pragma once

namespace broadside::bench {

// Adds "first-touch/KIND/WHICH/ENGINE" to the suites.
void register_feature_queries();

}  // namespace broadside::bench
