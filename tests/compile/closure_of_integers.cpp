// SPDX-License-Identifier: MIT
// error: hearth: no scalar_traits<Scalar>; include <hearth/eigen.hpp> for Eigen's numbers
#include <hearth/closure/ergun.hpp>

#ifdef MENDED
double exchange() { return hearth::closure::ergun::dimensionless_exchange(0.4, 100.0); }
#else
int exchange() { return hearth::closure::ergun::dimensionless_exchange(1, 100); }
#endif
