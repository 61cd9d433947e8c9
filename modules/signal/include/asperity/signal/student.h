#pragma once

namespace asperity {

// The probability that |t| of Student's distribution is at least `t`; 0 for an infinite t.
double student_two_sided(double t, double degrees_of_freedom);

// The t that |t| stays below with `confidence`, for example 0.95.
double student_quantile(double confidence, double degrees_of_freedom);

// The probability that F(a, b) is at least `f`.
double fisher_tail(double f, double a, double b);

}  // namespace asperity
