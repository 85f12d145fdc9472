// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <hearth/dem/contact_law.hpp>
#include <hearth/dem/particles.hpp>

namespace hearth::dem::detail {

/// Contacts side by side in arrays, so that the compiler computes several at once.  Loops always run over all lanes: a
/// trip count known at compile time vectorises without a remainder; unused lanes hold old, finite numbers.
template <bool Rolling>
struct contact_batch {
    static constexpr int lanes = 64;
    using lane = double[lanes];

    // Of the first body relative to the second.  A wall is a second body of no curvature and no inverse mass.
    alignas(64) lane dx, dy, dz;        // centre to centre, or foot on the wall to centre [m]
    alignas(64) lane radius_i, radius_j;  // radius_j of a wall is not read [m]
    alignas(64) lane inverse_mass;      // of both together: 1/M* [1/kg]
    alignas(64) lane vx, vy, vz;        // of the centres, or of the centre relative to the wall [m/s]
    alignas(64) lane wix, wiy, wiz, wjx, wjy, wjz;  // spins [rad/s]
    alignas(64) lane ax, ay, az;        // what the last acceleration adds to v in half a step [m/s]
    alignas(64) lane bx, by, bz;        // the same of radius_i spin_i + radius_j spin_j [m/s]
    alignas(64) lane sx, sy, sz;        // tangential spring, kept from step to step [m]
    // Results, on the first body.
    alignas(64) lane fx, fy, fz;        // force [N]
    alignas(64) lane qx, qy, qz;        // normal x tangential force [N]; torques are -lever_i q and -lever_j q
    alignas(64) lane lever_i, lever_j;  // [m]
    // Rolling: spring in, torque out.
    struct rolling_lanes {
        alignas(64) lane rx, ry, rz;  // relative rotation [rad]
        alignas(64) lane tx, ty, tz;  // torque on the first body [N m]
    };
    struct nothing {};
    std::conditional_t<Rolling, rolling_lanes, nothing> rolling;

    contact_batch() {
        for (int k = 0; k < lanes; ++k) {
            dx[k] = radius_i[k] = radius_j[k] = inverse_mass[k] = 1;
            dy[k] = dz[k] = vx[k] = vy[k] = vz[k] = 0;
            wix[k] = wiy[k] = wiz[k] = wjx[k] = wjy[k] = wjz[k] = sx[k] = sy[k] = sz[k] = 0;
            ax[k] = ay[k] = az[k] = bx[k] = by[k] = bz[k] = 0;
            if constexpr (Rolling) rolling.rx[k] = rolling.ry[k] = rolling.rz[k] = 0;
        }
    }

    /// Forces of all lanes, and their springs moved on by `step`.  Velocities are those of half a step ago, right for the
    /// springs; the dashpots add the acceleration of the half step that is missing.
    template <bool Wall, slip_rule Rule>
    void compute(const contact_law& law, double step) {
        const double normal_stiffness = law.normal_stiffness, tangential_stiffness = law.tangential_stiffness;
        const double damping = law.settings.damping, friction = law.settings.friction;
        const double rolling_friction = law.settings.rolling_friction;
        for (int k = 0; k < lanes; ++k) {
            const double distance = std::sqrt(dx[k] * dx[k] + dy[k] * dy[k] + dz[k] * dz[k]);
            const double inverse = 1 / distance;
            const double nx = dx[k] * inverse, ny = dy[k] * inverse, nz = dz[k] * inverse;
            const double ri = radius_i[k], rj = Wall ? 0.0 : radius_j[k];
            const double overlap = ri + rj - distance;
            const double inverse_sum = Wall ? 0.0 : 1 / (ri + rj);
            const double effective_radius = Wall ? ri : ri * rj * inverse_sum;
            double li, lj;  // levers: the overlap is shared as two equal springs in series would, R_j to i and R_i to j
            if constexpr (Rule == slip_rule::paper) {
                li = ri;
                lj = rj;
            } else {
                li = Wall ? distance : ri - overlap * rj * inverse_sum;
                lj = Wall ? 0.0 : rj - overlap * ri * inverse_sum;
            }
            const double s = std::sqrt(effective_radius * (overlap > 0 ? overlap : 0.0));
            const double kn = normal_stiffness * s;
            const double kt = tangential_stiffness * s;
            const double eta = damping * std::sqrt(kn / inverse_mass[k]);

            const double un = vx[k] * nx + vy[k] * ny + vz[k] * nz;
            const double an = ax[k] * nx + ay[k] * ny + az[k] * nz;
            const double fn = kn * overlap - eta * (un + an);

            // Slip velocity of the two surfaces: v - n (n.v) - (li wi + lj wj) x n.
            const double wx = li * wix[k] + lj * wjx[k], wy = li * wiy[k] + lj * wjy[k],
                         wz = li * wiz[k] + lj * wjz[k];
            const double ux = vx[k] - un * nx - (wy * nz - wz * ny);
            const double uy = vy[k] - un * ny - (wz * nx - wx * nz);
            const double uz = vz[k] - un * nz - (wx * ny - wy * nx);

            const double dux = ux + ax[k] - an * nx - (by[k] * nz - bz[k] * ny);
            const double duy = uy + ay[k] - an * ny - (bz[k] * nx - bx[k] * nz);
            const double duz = uz + az[k] - an * nz - (bx[k] * ny - by[k] * nx);

            // The spring turns with the contact plane and is stretched by the slip.
            const double along = sx[k] * nx + sy[k] * ny + sz[k] * nz;
            double xi = sx[k] - along * nx + ux * step;
            double yi = sy[k] - along * ny + uy * step;
            double zi = sz[k] - along * nz + uz * step;
            const double limit = friction * std::fabs(fn);
            const double spring = kt * std::sqrt(xi * xi + yi * yi + zi * zi);
            const bool slips = spring > limit;
            double tx, ty, tz;
            if constexpr (Rule == slip_rule::paper) {
                const double speed = std::sqrt(dux * dux + duy * duy + duz * duz);
                const double sliding = speed > 0 ? limit / speed : 0.0;
                tx = slips ? -sliding * dux : -kt * xi - eta * dux;
                ty = slips ? -sliding * duy : -kt * yi - eta * duy;
                tz = slips ? -sliding * duz : -kt * zi - eta * duz;
                const double keep = slips ? 0.0 : 1.0;
                xi *= keep;
                yi *= keep;
                zi *= keep;
            } else {
                const double keep = slips ? limit / spring : 1.0;
                xi *= keep;
                yi *= keep;
                zi *= keep;
                tx = -kt * xi - eta * dux;
                ty = -kt * yi - eta * duy;
                tz = -kt * zi - eta * duz;
                const double size = std::sqrt(tx * tx + ty * ty + tz * tz);
                const double cut = size > limit ? limit / size : 1.0;
                tx *= cut;
                ty *= cut;
                tz *= cut;
            }
            sx[k] = xi;
            sy[k] = yi;
            sz[k] = zi;
            fx[k] = fn * nx + tx;
            fy[k] = fn * ny + ty;
            fz[k] = fn * nz + tz;
            qx[k] = ny * tz - nz * ty;
            qy[k] = nz * tx - nx * tz;
            qz[k] = nx * ty - ny * tx;
            lever_i[k] = li;
            lever_j[k] = lj;
            if constexpr (Rolling) {
                auto& r = rolling;
                const double cx = wix[k] - (Wall ? 0.0 : wjx[k]), cy = wiy[k] - (Wall ? 0.0 : wjy[k]),
                             cz = wiz[k] - (Wall ? 0.0 : wjz[k]);
                const double twist = cx * nx + cy * ny + cz * nz;
                const double turned = r.rx[k] * nx + r.ry[k] * ny + r.rz[k] * nz;
                const double rx = r.rx[k] - turned * nx + (cx - twist * nx) * step;
                const double ry = r.ry[k] - turned * ny + (cy - twist * ny) * step;
                const double rz = r.rz[k] - turned * nz + (cz - twist * nz) * step;
                const double kr = kt * effective_radius * effective_radius;
                const double torque = kr * std::sqrt(rx * rx + ry * ry + rz * rz);
                const double most = rolling_friction * effective_radius * std::fabs(fn);
                const double keep = torque > most ? most / torque : 1.0;
                r.rx[k] = rx * keep;
                r.ry[k] = ry * keep;
                r.rz[k] = rz * keep;
                r.tx[k] = -kr * r.rx[k];
                r.ty[k] = -kr * r.ry[k];
                r.tz[k] = -kr * r.rz[k];
            }
        }
    }
};

}  // namespace hearth::dem::detail
