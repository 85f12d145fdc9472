// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/gas/model.hpp>

/// Two gases with a heat capacity that rises with temperature: fuel and bath.
class two_gases final : public hearth::gas::gas_model {
  public:
    int species_count() const override { return 2; }
    double density(double p, double t, const double* y) const override {
        return p / (8.31446261815324 * t * (y[0] / 0.016 + y[1] / 0.029));
    }
    double enthalpy(double t, const double* y) const override {
        return y[0] * (-4.6e6 + 2200 * t + 0.9 * t * t) + y[1] * (950 * t + 0.1 * t * t);
    }
    double specific_heat(double t, const double* y) const override {
        return y[0] * (2200 + 1.8 * t) + y[1] * (950 + 0.2 * t);
    }
    double viscosity(double t, const double*) const override { return 1.8e-5 * std::pow(t / 300, 0.7); }
    double conductivity(double t, const double* y) const override { return viscosity(t, y) * specific_heat(t, y) / 0.7; }
};
