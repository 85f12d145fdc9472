// SPDX-License-Identifier: MIT
#pragma once

#include <hearth/core/constants.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/scalar.hpp>

namespace hearth::closure {

/// Two bodies in contact, as conduction sees them.
template <class Scalar>
struct contact_pair {
    Scalar contact_radius;  ///< of the true modulus, see hertz.hpp [m]
    Scalar normal_force;    ///< [N]
    Scalar conductivity_i;  ///< [W/(m K)], > 0
    Scalar conductivity_j;  ///< [W/(m K)], > 0
    Scalar radius_i;        ///< [m]
    Scalar radius_j;        ///< 0 for a wall whose temperature is that of its surface [m]
};

/// Conduction through the contact of two particles, or of a particle and a wall.
/// The paper (Spijker et al. 2023, doi:10.1002/ceat.202200617) prints Eqs. 2 and 3 as Q = A/R_th (Tj - Ti) after Zhang,
/// with R_th in m K/W: a length is missing.  The closures here are the readings that are closed in dimension.
/// Each gives a conductance H [W/K], symmetric in the two bodies; heat into i is H (Tj - Ti).
struct zhang {
    struct constriction;
    struct series;
    struct micro_gap;
    using paper = series;  ///< what Eqs. 2 and 3 say if taken by the letter

    /// k_m = 2 k1 k2 / (k1 + k2) [W/(m K)].
    template <class Scalar>
    HEARTH_FUNCTION static Scalar mean_conductivity(const contact_pair<Scalar>& pair) {
        using real = real_t<Scalar>;
        return real(2) * pair.conductivity_i * pair.conductivity_j / (pair.conductivity_i + pair.conductivity_j);
    }
};

/// H = 2 k_m a: heat that narrows to a circle of radius a between two half spaces.  The default.
/// Batchelor, O'Brien, Proc. R. Soc. A 355 (1977) 313, doi:10.1098/rspa.1977.0100.  It is Eq. 2 with R_th = 1/k_m over
/// the length pi a/2.  Valid for a much smaller than the radii and particles that conduct far better than the gas.
struct zhang::constriction {
    /// [W/K]
    template <class Scalar>
    HEARTH_FUNCTION static Scalar conductance(const contact_pair<Scalar>& pair) {
        return real_t<Scalar>(2) * mean_conductivity(pair) * pair.contact_radius;
    }
};

/// H = A / (R1/k1 + R2/k2 + R''): plane conduction through columns of the contact's area A = pi a^2 to the centres.
/// The literal reading of the paper's Eqs. 2 and 3.  It is two to three orders below constriction for stiff spheres,
/// because heat does not keep to a column.
struct zhang::series {
    /// surface_resistance R'' is of the contact's faces [m^2 K/W].  Throws bad_value unless finite and >= 0.
    explicit series(double surface_resistance = 0) : surface_resistance_(surface_resistance) {
        if (!(surface_resistance >= 0 && surface_resistance - surface_resistance == 0))
            throw bad_value("surface_resistance of closure zhang::series", bad_value::no_index, surface_resistance,
                            "finite and >= 0 [m^2 K/W]");
    }

    /// [W/K]
    template <class Scalar>
    HEARTH_FUNCTION Scalar conductance(const contact_pair<Scalar>& pair) const {
        using real = real_t<Scalar>;
        const Scalar resistance =
            pair.radius_i / pair.conductivity_i + pair.radius_j / pair.conductivity_j + real(surface_resistance_);
        return constants<real>::pi() * square(pair.contact_radius) / resistance;
    }

  private:
    double surface_resistance_;
};

/// 1/H = 1/(2 k_m a) + 1/(h_c A): constriction in series with the roughness of the two faces,
/// h_c = 1.25 k_m m/s (p/H)^0.95 with the mean pressure p = F/A.
/// Cooper, Mikic, Yovanovich, Int. J. Heat Mass Transfer 12 (1969) 279, doi:10.1016/0017-9310(69)90011-8; conforming
/// rough faces that deform plastically, without gas in the gaps.
struct zhang::micro_gap {
    /// The two faces together: s the rms height [m], m the mean slope [-]; H of the softer one [Pa].
    struct surface {
        double rms_height;
        double mean_slope;
        double hardness;
    };

    /// Throws bad_value unless all three are > 0.
    explicit micro_gap(const surface& faces)
        : slope_per_height_(faces.mean_slope / faces.rms_height), hardness_(faces.hardness) {
        require(faces.rms_height, "rms_height", "> 0 [m]");
        require(faces.mean_slope, "mean_slope", "> 0 [-]");
        require(faces.hardness, "hardness", "> 0 [Pa]");
    }

    /// [W/K]; 0 without contact.
    template <class Scalar>
    HEARTH_FUNCTION Scalar conductance(const contact_pair<Scalar>& pair) const {
        using real = real_t<Scalar>;
        const Scalar area = constants<real>::pi() * square(pair.contact_radius);
        const Scalar pressing = at_least(pair.normal_force, real(0));
        // h_c A with A drawn into the power: A^0.05 (F/H)^0.95, which needs no pressure where there is no contact.
        const Scalar faces = real(1.25) * mean_conductivity(pair) * real(slope_per_height_) * power(area, real(0.05)) *
                             power(Scalar(pressing / real(hardness_)), real(0.95));
        const Scalar narrowing = constriction::conductance(pair);
        const Scalar sum = faces + narrowing;
        return faces * narrowing / select(sum > real(0), sum, uniform(sum, real(1)));
    }

  private:
    static void require(double value, const char* name, const char* allowed) {
        if (!(value > 0))
            throw bad_value(std::string(name) + " of closure zhang::micro_gap", bad_value::no_index, value, allowed);
    }

    double slope_per_height_;
    double hardness_;
};

}  // namespace hearth::closure
