// SPDX-License-Identifier: MIT
// The heated bed of Fig. 6 of Spijker et al. (2023, doi:10.1002/ceat.202200617) with and without Time Scale Splitting.
//     bed SPLIT PLAIN LIMIT      folders of two runs, and how far they may be apart [-], of the inlet's step of 100 K
// In both folders NAME/spheres hold number, x y z, velocity and temperature: NAME is the model's time, 200 times less
// in SPLIT.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <hearth/closure/gunn.hpp>

#include "support/schumann.hpp"

namespace {

constexpr std::array<double, 3> heights{0.02, 0.05, 0.1};  // [m]

struct bed {
    std::array<double, 3> temperature{};  // mean over 10 mm about each height [K]
    int spheres = 0, below = 0;           // all, and between 10 and 130 mm
};

/// Of all ranks.
bed read(const std::string& folder, const std::string& time) {
    bed result;
    std::array<int, 3> counts{};
    const auto add = [&](const std::filesystem::path& name) {
        std::ifstream file(name);
        for (double id, x, y, z, v, t; file >> id >> x >> y >> z >> v >> t;) {
            ++result.spheres;
            result.below += z > 0.01 && z < 0.13;
            for (std::size_t k = 0; k < heights.size(); ++k) {
                if (std::abs(z - heights[k]) > 0.005) continue;
                result.temperature[k] += t;
                ++counts[k];
            }
        }
    };
    add(folder + "/" + time + "/spheres");
    for (const char* rank : {"/processor0/", "/processor1/"}) add(folder + rank + time + "/spheres");
    for (std::size_t k = 0; k < heights.size(); ++k) result.temperature[k] /= counts[k];
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    constexpr double diameter = 0.01, superficial = 0.5, density = 0.8825, viscosity = 2.31e-5, conductivity = 0.0333;
    constexpr double gas_heat = 1014, solid_density = 2500, solid_heat = 840, area = 0.04 * 0.04;
    const double limit = std::atof(argv[3]);
    std::printf("process time [s], at 20, 50, 100 mm split, plain, Schumann [K]\n");
    double apart = 0, from_schumann = 0;
    int spheres = 0;
    for (const int quarter : {1, 2, 3, 4}) {
        const double time = 100.0 * quarter;
        char split_time[16], plain_time[16];
        std::snprintf(split_time, sizeof split_time, "%g", time / 200);
        std::snprintf(plain_time, sizeof plain_time, "%g", time);
        const bed split = read(argv[1], split_time), plain = read(argv[2], plain_time);
        if (split.spheres == 0 || split.spheres != plain.spheres) return 2;
        spheres = split.spheres;
        const double solid = plain.below * std::acos(-1.0) / 6 * diameter * diameter * diameter / (area * 0.12);
        const double nusselt = hearth::closure::gunn::nusselt(1 - solid, density * superficial * diameter / viscosity,
                                                              viscosity * gas_heat / conductivity);
        const double exchange = nusselt * conductivity / diameter * 6 * solid / diameter;  // h a [W/(m^3 K)]
        std::printf("%4.0f:", time);
        std::array<double, 3> exact{};
        for (std::size_t k = 0; k < heights.size(); ++k) {
            const double xi = exchange * heights[k] / (density * gas_heat * superficial);
            const double tau = exchange * time / (solid * solid_density * solid_heat);
            exact[k] = 300 + 100 * static_cast<double>(hearth_test::schumann::solid(xi, tau));
            apart = std::max(apart, std::abs(split.temperature[k] - plain.temperature[k]) / 100);
            from_schumann = std::max(from_schumann, std::abs(plain.temperature[k] - exact[k]) / 100);
        }
        for (const std::array<double, 3>& row : {split.temperature, plain.temperature, exact})
            std::printf("  %.2f %.2f %.2f", row[0], row[1], row[2]);
        std::printf("\n");
    }
    std::printf("%d spheres; split from plain by %.2f %%, plain from Schumann's uniform bed by %.2f %% of the step\n",
                spheres, 100 * apart, 100 * from_schumann);
    return apart < limit && from_schumann < 0.05 ? 0 : 1;
}
