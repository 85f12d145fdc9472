// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/gas/array.hpp>
#include <hearth/gas/mesh.hpp>

namespace hearth::gas {

/// Least-squares gradients, exact for linear fields on any mesh.  Built once per mesh.
class gradient {
  public:
    explicit gradient(const mesh& m);

    /// Gradients of `Width` fields that are stored cell by cell.  `boundary` holds the values on the boundary faces,
    /// `field` its ghosts.  The results of owned cells are written; ghosts are the caller's to gather.
    template <int Width>
    void compute(const double* field, const double* boundary, vector3* out) const;

    /// Turns, for each owned cell, the sum over its faces of d difference / |d|^2 into the gradient that fits the
    /// differences best; d as in the constructor, from the cell to its neighbour or to its boundary face.
    template <int Width = 1>
    void solve(vector3* sums) const;

  private:
    const mesh* mesh_;
    struct symmetric { double xx, xy, xz, yy, yz, zz; };
    array<symmetric> inverse_;
};

/// van Albada's limiter on a face between the upwind cell and the downwind one (Astron. Astrophys. 108 (1982) 76), with
/// the far upwind difference taken from the gradient.  Smoother than van Leer's: outer iterations do not chatter.
/// Returns what to add to the upwind value.  `share` is the distance of the face from the upwind cell over that of the
/// two centres; `slope` the upwind gradient times the vector between the centres.
inline double limited_correction(double difference, double slope, double share) {
    const double behind = 2 * slope - difference;  // difference across the cell behind the upwind one
    const double product = behind * difference;
    if (!(product > 0)) return 0;                  // an extremum: first order
    const double mean = product * (behind + difference) / (behind * behind + difference * difference);
    const double correction = share * mean;
    return std::abs(correction) > std::abs(difference) ? difference : correction;
}

}  // namespace hearth::gas
