// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/closure/drag.hpp>

/// Exchange coefficients and forces computed elsewhere for air of 1.2 kg/m^3 and 1.8e-5 Pa s and spheres of 14 mm,
/// printed with nine digits.
namespace hearth_test {

struct drag_row {
    double void_fraction, slip_speed;            // [-], interstitial [m/s]
    double ergun, wen_yu, gidaspow;              // [kg/(m^3 s)]
    double force_ergun_wen_yu, force_di_felice;  // on one particle [N]
    double beetstra;                             // [kg/(m^3 s)]
};

inline constexpr drag_row drag_table[]{
    {0.36, 0.1, 2.52734694e+01, 4.24630989e+01, 2.52734694e+01, 1.57603231e-05, 5.74171346e-06, 2.76868000e+01},
    {0.36, 3, 3.03673469e+02, 2.93068575e+02, 3.03673469e+02, 5.68104672e-03, 2.32481597e-03, 2.35614741e+02},
    {0.4, 1, 1.02397959e+02, 1.09896895e+02, 1.02397959e+02, 6.13003267e-04, 2.41996514e-04, 8.36752143e+01},
    {0.5, 3, 2.31887755e+02, 1.33155130e+02, 2.31887755e+02, 3.99799081e-03, 1.38253790e-03, 1.45795369e+02},
    {0.7, 0.1, 6.27113703e+00, 4.65671087e+00, 6.27113703e+00, 4.29051797e-06, 2.03458237e-06, 5.43051516e+00},
    {0.79, 1, 3.22689873e+01, 9.72596677e+00, 3.22689873e+01, 2.79461303e-04, 8.45111361e-05, 1.57648779e+01},
    {0.81, 1, 2.91139456e+01, 8.36873277e+00, 8.36873277e+00, 7.81274788e-05, 8.11341173e-05, 1.37932620e+01},
    {0.9, 0.1, 1.65306122e+00, 9.06593634e-01, 9.06593634e-01, 1.44728108e-06, 1.38135622e-06, 1.14553567e+00},
    {0.99, 3, 4.50139147e+00, 8.62760660e-01, 8.62760660e-01, 3.75629008e-04, 4.39342818e-04, 1.26779793e+00}};

/// Half a unit of the ninth digit.
inline constexpr double drag_table_precision = 5e-9;

inline hearth::closure::bed_flow<double> flow_of(const drag_row& row) {
    return {row.void_fraction, row.slip_speed, 1.2, 1.8e-5, 0.014};
}

}  // namespace hearth_test
