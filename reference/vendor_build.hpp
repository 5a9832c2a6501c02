// Which vendor library is really loaded, in words for the build stamp.
#pragma once

#include <string>

namespace broadside::reference {

std::string bullet_build();  // "Bullet 3.24 (libBulletCollision.so.3.24), float"
std::string fcl_build();     // "FCL 0.7.0 (libfcl.so.0.7.0), double"
std::string ccd_build();     // "libccd 2.1 (libccd.so.2.0), double"

}  // namespace broadside::reference
