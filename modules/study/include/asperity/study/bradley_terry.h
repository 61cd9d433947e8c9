#pragma once

#include <Eigen/Core>

namespace asperity {

// Worths of things that were compared in pairs (Bradley and Terry 1952).
struct BradleyTerry {
  bool exists = false;         // false: some part of the things won always, or was never compared with the rest
  bool converged = false;      // of the iteration
  Eigen::VectorXd worth_ln;    // ln π, with mean 0
  Eigen::MatrixXd covariance;  // of worth_ln; the variance of a difference i − j is c_ii + c_jj − 2 c_ij
};

// `wins`: n × n, (i, j) how often i was preferred to j; the diagonal counts for nothing. By minorisation-maximisation
// (Hunter 2004, eq. 3); the covariance is the pseudo-inverse of the Fisher information. Throws Error for a matrix that
// is not square or has numbers that are negative or not finite.
BradleyTerry fit_bradley_terry(const Eigen::MatrixXd& wins);

}  // namespace asperity
