#pragma once
/// The number type of the reference solution: 50 decimal digits, no expression templates.
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

namespace slapstick::oracle {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Vector = std::vector<Real>;

/// A value is called zero when it is below this share of the terms that it is the sum of (their rounding is near
/// 1e-49).
inline const Real zero_share{"1e-30"};

inline Real pi() { return boost::math::constants::pi<Real>(); }

/// Each double, taken as exact.
inline Vector to_real(const std::vector<double>& values) { return Vector(values.begin(), values.end()); }

}  // namespace slapstick::oracle
