#include "reference/vendor_build.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <LinearMath/btScalar.h>
#include <ccd/ccd.h>
#include <fcl/common/time.h>
#include <fcl/config.h>

#include <Eigen/Core>
#include <cstdio>
#include <optional>
#include <utility>

#include "reference/loaded_library.hpp"

namespace broadside::reference {
namespace {

std::string build_of(const void* address) {
  const std::optional<bool> asserts = library_mentions(address, "__assert_fail");
  if (!asserts) return "unknown";
  return *asserts ? "asserts are compiled in, and abort" : "no asserts";
}

}  // namespace

std::string bullet_build() {
  const int version = btGetVersion();  // 324 means 3.24
  const int minor = version % 100;
  return "Bullet " + std::to_string(version / 100) + (minor < 10 ? ".0" : ".") + std::to_string(minor) + " (" +
         loaded_library(&gDbvtMargin) + "), " + (sizeof(btScalar) == sizeof(float) ? "float" : "double");
}

std::string fcl_build() {
  return std::string("FCL ") + FCL_VERSION + " (" + loaded_library(reinterpret_cast<const void*>(&fcl::time::now)) +
         "), double";
}

std::string ccd_build() {
  // The headers carry no version; the name of the loaded file does.
  return "libccd (" + loaded_library(reinterpret_cast<const void*>(&ccdGJKIntersect)) + "), " +
         (sizeof(ccd_real_t) == sizeof(float) ? "float" : "double");
}

core::EquivalenceCard library_card(std::string loaded, const void* address, const char* precision, std::string simd,
                                   int threads) {
  return {{"library loaded", std::move(loaded), ""},
          {"library build", build_of(address), ""},
          {"precision", precision, ""},
          {"SIMD", std::move(simd), ""},
          {"threads", std::to_string(threads), ""}};
}

core::EquivalenceCard own_card(std::string build, const char* precision, std::string simd, int threads) {
#ifdef NDEBUG
  const char* asserts = "this program's own, no asserts";
#else
  const char* asserts = "this program's own, with asserts";
#endif
  return {{"library loaded", std::move(build), ""},
          {"library build", asserts, ""},
          {"precision", precision, ""},
          {"SIMD", std::move(simd), ""},
          {"threads", std::to_string(threads), ""}};
}

core::EquivalenceCard bullet_card() {
#ifdef BT_USE_SSE
  const char* simd = "SSE, as its headers are compiled here";
#else
  const char* simd = "none in its headers; the library's own code as the compiler made it";
#endif
  return library_card(bullet_build(), &gDbvtMargin, sizeof(btScalar) == sizeof(float) ? "float32" : "float64", simd, 1);
}

core::EquivalenceFact bullet_margin_fact(float margin_m) {
  if (margin_m == 0.0F) return {"broad-phase margin", "none", ""};
  char text[64];
  std::snprintf(text, sizeof text, "%.4g m on leaves that moved", static_cast<double>(margin_m));
  return {"broad-phase margin", text, "none"};
}

core::EquivalenceFact shape_margin_fact(float margin_m) {
  if (margin_m == 0.0F) return {"shape margin", "none", ""};
  char text[96];
  std::snprintf(text, sizeof text, "%.4g m around hulls and triangles, and rounding the edges of boxes",
                static_cast<double>(margin_m));
  return {"shape margin", text, "none"};
}

core::EquivalenceCard fcl_card(int threads) {
  return library_card(fcl_build(), reinterpret_cast<const void*>(&fcl::time::now), "float64",
                      std::string("Eigen: ") + Eigen::SimdInstructionSetsInUse(), threads);
}

core::EquivalenceCard ccd_card(int threads) {
  return library_card(ccd_build(), reinterpret_cast<const void*>(&ccdGJKIntersect),
                      sizeof(ccd_real_t) == sizeof(float) ? "float32" : "float64", "none", threads);
}

}  // namespace broadside::reference
