#include "reference/vendor_build.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <LinearMath/btScalar.h>
#include <ccd/ccd.h>
#include <fcl/common/time.h>
#include <fcl/config.h>

#include "reference/loaded_library.hpp"

namespace broadside::reference {

std::string bullet_build() {
  const int version = btGetVersion();  // 324 is 3.24
  const int minor = version % 100;
  return "Bullet " + std::to_string(version / 100) + (minor < 10 ? ".0" : ".") + std::to_string(minor) + " (" +
         loaded_library(&gDbvtMargin) + "), " + (sizeof(btScalar) == sizeof(float) ? "float" : "double");
}

std::string fcl_build() {
  return std::string("FCL ") + FCL_VERSION + " (" + loaded_library(reinterpret_cast<const void*>(&fcl::time::now)) +
         "), double";
}

std::string ccd_build() {
  // Its headers carry no version; the file that was loaded does.
  return "libccd (" + loaded_library(reinterpret_cast<const void*>(&ccdGJKIntersect)) + "), " +
         (sizeof(ccd_real_t) == sizeof(float) ? "float" : "double");
}

}  // namespace broadside::reference
