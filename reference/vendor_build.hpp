// The vendor library that is really loaded, in words for the build stamp.
#pragma once

#include <string>

#include "core/engine/equivalence.hpp"

namespace broadside::reference {

std::string bullet_build();  // "Bullet 3.24 (libBulletCollision.so.3.24), float"
std::string fcl_build();     // "FCL 0.7.0 (libfcl.so.0.7.0), double"
std::string ccd_build();     // "libccd 2.1 (libccd.so.2.0), double"

// Facts that hold for every engine made of a library: file loaded, its build as far as that shows, precision, SIMD,
// threads. `threads` is what the adapter uses. The library is the one that contains `address`.
core::EquivalenceCard library_card(std::string loaded, const void* address, const char* precision, std::string simd,
                                   int threads);
// The same for an engine that is compiled into this program.
core::EquivalenceCard own_card(std::string build, const char* precision, std::string simd, int threads);
core::EquivalenceCard bullet_card();
core::EquivalenceFact bullet_margin_fact(float margin_m);  // of a broad phase whose leaves are fattened by this
core::EquivalenceFact shape_margin_fact(float margin_m);   // of shapes that are made with this margin
core::EquivalenceCard fcl_card(int threads);
core::EquivalenceCard ccd_card(int threads);

}  // namespace broadside::reference
