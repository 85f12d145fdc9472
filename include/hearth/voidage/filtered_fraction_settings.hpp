// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include <hearth/voidage/vfs.hpp>

namespace hearth {

/// How particle volume becomes a solid fraction.
struct filtered_fraction_settings {
    /// Standard deviation of the kernel [m].  Default: half the volume-weighted mean diameter,
    /// d = sum V_p d_p / sum V_p over all particles, so that fines among lumps do not shrink the scale on which the
    /// closures' porosity is meant.  A bed of two sizes apart in space may want two operators.
    std::optional<double> width;
    /// Largest solid fraction of a cell [-]; what is above goes to the neighbours.  The densest packing of spheres has
    /// 0.74; in random beds the kernel leaves nothing above that.  Where the cap works, a cell that comes to the threshold
    /// makes the field jump, as nothing else does: by at most 0.2 of the moving particle's volume at a threshold 0.05
    /// above the mean, 0.35 at 0.02 (own search).
    double threshold = 0.74;
    /// Of the kernel's series, see kernel_smoother.
    double tolerance = 1e-5;
};

/// What a call that made a solid fraction did, over all ranks.
struct filtered_fraction_report {
    std::int64_t particles = 0;
    double solid_volume = 0;        ///< of all particles [m^3]
    double width = 0;               ///< standard deviation of the kernel that was used [m]
    int terms = 0;                  ///< of its series
    double deposited_maximum = 0;   ///< largest solid fraction before smoothing [-]
    double smoothed_maximum = 0;    ///< after smoothing, before the cap [-]
    double maximum = 0;             ///< of the result [-]
    double capped_volume = 0;       ///< solid that smoothing left above the threshold and the cap moved [m^3]
    vfs_report cap;                 ///< what the cap did
    bool tightened = false;         ///< the series undershot zero and was taken to round-off instead
    std::int64_t zeroed_cells = 0;  ///< cells in which round-off below zero was set to zero
    double zeroed_volume = 0;       ///< the solid so gained [m^3]
};

}  // namespace hearth
