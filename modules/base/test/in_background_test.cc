#include "asperity/base/in_background.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace asperity {
namespace {

TEST(InBackground, GivesTheResultAndTheFault) {
  const int begin = 20;
  auto sum = in_background([&] { return begin + 3; });
  auto fault = in_background([]() -> int { throw std::runtime_error("no"); });
  EXPECT_EQ(sum.get(), 23);
  EXPECT_THROW(fault.get(), std::runtime_error);
}

TEST(InBackground, WaitsForWhatNobodyAsksFor) {
  bool done = false;
  {
    const auto work = in_background([&] { done = true; });
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace asperity
