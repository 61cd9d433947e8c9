#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "asperity/signal/student.h"

namespace asperity {
namespace {

// Published tables; one degree of freedom is Cauchy's distribution, in closed form.
TEST(Student, HasTheQuantilesOfTables) {
  EXPECT_NEAR(student_quantile(0.95, 1.0), std::tan(0.475 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(student_quantile(0.95, 2.0), 4.302653, 1e-6);
  EXPECT_NEAR(student_quantile(0.95, 10.0), 2.228139, 1e-6);
  EXPECT_NEAR(student_quantile(0.99, 30.0), 2.749996, 1e-6);
}

TEST(Student, ItsTailIsTheQuantilesInverse) {
  for (const double freedom : {1.0, 2.5, 7.0, 40.0}) {
    EXPECT_NEAR(student_two_sided(student_quantile(0.95, freedom), freedom), 0.05, 1e-9) << freedom;
  }
}

TEST(Student, NothingOverNothingShowsNothing) {
  EXPECT_EQ(student_two_sided(std::nan(""), 3.0), 1.0);
  EXPECT_EQ(student_two_sided(INFINITY, 3.0), 0.0);
}

}  // namespace
}  // namespace asperity
