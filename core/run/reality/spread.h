#pragma once
#include <span>

namespace btr {

/// Mean and spread of repeats.
struct Spread {
  int count = 0;
  double mean = 0;           ///< 0 without values
  double deviation = 0;      ///< sample standard deviation (n − 1); 0 below two values
  double standardError = 0;  ///< deviation / √n
  double halfWidth95 = 0;  ///< of the 95 % confidence interval of the mean, Student's t with n − 1 degrees of freedom
};
Spread spreadOf(std::span<const double> values);

}  // namespace btr
