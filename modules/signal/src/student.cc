#include "asperity/signal/student.h"

#include <cmath>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace asperity {

double student_two_sided(double t, double degrees_of_freedom) {
  if (std::isnan(t)) return 1.0;  // nothing over nothing: data without any error show nothing
  if (!std::isfinite(t)) return 0.0;
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees_of_freedom), std::abs(t)));
}

double student_quantile(double confidence, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.5 + 0.5 * confidence);
}

double fisher_tail(double f, double a, double b) {
  if (std::isnan(f)) return 1.0;
  if (!std::isfinite(f)) return 0.0;
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(a, b), f));
}

}  // namespace asperity
