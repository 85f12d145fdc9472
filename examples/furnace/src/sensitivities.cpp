// SPDX-License-Identifier: MIT
#include <cstdio>

#include <hearth/furnace/sensitivities.hpp>

namespace hearth::furnace {
namespace {

struct change {
    const char* input;
    const char* unit;
    bool in_paper;
    double to_unit;  // from SI
    double (*get)(const settings&);
    void (*set)(settings&, double);
    double (*less)(double), (*more)(double);
};

template <int Percent>
double scaled(double value) {
    return value * (1 + 0.01 * Percent);
}

const change changes[] = {
    {"burner flow", "kg/s", false, 1, [](const settings& s) { return s.burners.mass_flow; },
     [](settings& s, double v) { s.burners.mass_flow = v; }, scaled<-10>, scaled<10>},
    {"equivalence ratio", "", false, 1, [](const settings& s) { return s.burners.equivalence_ratio; },
     [](settings& s, double v) { s.burners.equivalence_ratio = v; }, scaled<-10>, scaled<10>},
    {"temperature of the burner gas", "K", false, 1, [](const settings& s) { return s.burners.temperature; },
     [](settings& s, double v) { s.burners.temperature = v; }, [](double v) { return v; },
     [](double v) { return v + 100; }},
    {"loss of the wall, U", "W/(m2 K)", false, 1,
     [](const settings& s) { return s.shaft.zones.empty() ? 0 : s.shaft.zones.front().transmittance; },
     [](settings& s, double v) {
         const double before = s.shaft.zones.empty() ? 0 : s.shaft.zones.front().transmittance;
         for (wall_zone& zone : s.shaft.zones) zone.transmittance = before > 0 ? zone.transmittance * v / before : v;
     },
     [](double) { return 0.0; }, [](double v) { return 2 * v; }},
    {"void fraction", "", false, 1, [](const settings& s) { return s.bed.void_fraction; },
     [](settings& s, double v) { s.bed.void_fraction = v; }, [](double v) { return v - 0.02; },
     [](double v) { return v + 0.02; }},
    {"emissivity of the stones", "", false, 1, [](const settings& s) { return s.particles.emissivity; },
     [](settings& s, double v) { s.particles.emissivity = v; }, scaled<-20>, [](double v) { return v; }},
    {"flow of solids", "kg/h", true, 3600, [](const settings& s) { return s.particles.mass_flow; },
     [](settings& s, double v) { s.particles.mass_flow = v; }, scaled<-3>, scaled<3>},
    {"flow of secondary air", "Nm3/h", true, 3600, [](const settings& s) { return s.air.volume_flow; },
     [](settings& s, double v) { s.air.volume_flow = v; }, scaled<-3>, scaled<3>}};

}  // namespace

std::vector<sensitivity> sensitivities(const settings& scene) {
    check(scene);
    std::vector<sensitivity> all;
    for (const change& c : changes) {
        const double value = c.get(scene), less = c.less(value), more = c.more(value);
        settings low = scene, high = scene;
        c.set(low, less);
        c.set(high, more);
        char text[96];
        std::snprintf(text, sizeof text, "%s, %.4g to %.4g %s", c.input, less * c.to_unit, more * c.to_unit, c.unit);
        all.push_back({text, c.in_paper, solve_shaft_profile(low), solve_shaft_profile(high)});
    }
    return all;
}

}  // namespace hearth::furnace
