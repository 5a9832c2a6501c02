// When a library throws, its own cell is lost and nothing else: the exception becomes one clear error.
#include "reference/vendor_call.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace broadside::reference {
namespace {

TEST(VendorCall, PassesResultsOn) {
  const auto result = vendor_call("engine: find", [] { return core::Result<int>(7); });
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value(), 7);
}

TEST(VendorCall, ExceptionsBecomeErrorsThatNameTheStage) {
  const auto thrown = vendor_call("fcl-tree: find", []() -> core::Status { throw std::runtime_error("no root"); });
  ASSERT_FALSE(thrown.ok());
  EXPECT_EQ(thrown.error().line().rfind("fcl-tree: find: the library threw: no root", 0), 0U);
  EXPECT_EQ(thrown.error().exit, core::Exit::kMissing);

  const auto memory = vendor_call("fcl-tree: load", []() -> core::Status { throw std::bad_alloc(); });
  ASSERT_FALSE(memory.ok());
  EXPECT_NE(memory.error().line().find("out of memory"), std::string::npos);

  const auto odd = vendor_call("fcl-tree: load", []() -> core::Status { throw 3; });
  EXPECT_FALSE(odd.ok());
}

}  // namespace
}  // namespace broadside::reference
