// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <hearth/gas/generate.hpp>
#include <hearth/gas/solver.hpp>

#include "support/blown_bed.hpp"

/// Gas between spheres that the mesh resolves: cubes whose centre lies in a solid are left out; the friction of a cube
/// on the solid beside it acts over the true distance from its centre to the surface.
namespace hearth::test {

struct solids {
    packing spheres;
    double tube = 0;  ///< radius of a tube around the z axis; 0: none [m]

    static constexpr int gas = -1, wall = -2;

    /// The sphere that holds a point, or `wall` beyond the tube, or `gas`.
    int at(const gas::vector3& x) const {
        if (tube > 0 && x.x * x.x + x.y * x.y >= tube * tube) return wall;
        for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
            const double r = spheres.radii[i];
            if (std::abs(x.z - spheres.positions[i][2]) < r && norm(x - centre(i)) < r) return static_cast<int>(i);
        }
        return gas;
    }

    /// Share of the way from a point in the gas to one in a solid that lies in the gas, (0, 1].
    double gas_share(const gas::vector3& from, const gas::vector3& to, int solid) const {
        gas::vector3 d = to - from, a = solid == wall ? from : from - centre(static_cast<std::size_t>(solid));
        if (solid == wall) d.z = a.z = 0;
        const double r = solid == wall ? tube : spheres.radii[static_cast<std::size_t>(solid)];
        // |a + s d| = r: the way into a sphere is the smaller root, that out of the tube the greater
        const double dd = dot(d, d), half = dot(a, d), rest = dot(a, a) - r * r;
        const double root = std::sqrt(std::max(0.0, half * half - dd * rest));
        return std::clamp((-half + (solid == wall ? root : -root)) / dd, 1e-3, 1.0);
    }

  private:
    gas::vector3 centre(std::size_t i) const {
        const point& x = spheres.positions[i];
        return {x[0], x[1], x[2]};
    }
};

/// The gas's cubes in a box, those that can be reached from its bottom.  Patches: bottom, top, and side, which holds
/// the box's sides and the solids, is to be a slip wall.
struct resolved_space {
    gas::mesh mesh;
    gas::array<double> friction;  ///< exchange over viscosity [1/m^2]

    /// `count` cubes of size dx [m] each way from the corner `low`.
    resolved_space(const solids& solid, const gas::vector3& low, const std::array<int, 3>& count, double dx) {
        const int nx = count[0], ny = count[1], nz = count[2], stride[3] = {1, nx, nx * ny};
        const auto centre = [&](int c) {
            return low + dx * gas::vector3{c % nx + 0.5, c / nx % ny + 0.5, c / stride[2] + 0.5};
        };
        /// Visits the cubes beside one.
        const auto beside = [&](int c, const auto& visit) {
            const int at[3] = {c % nx, c / nx % ny, c / stride[2]}, n[3] = {nx, ny, nz};
            for (int axis = 0; axis < 3; ++axis) {
                if (at[axis] > 0) visit(c - stride[axis]);
                if (at[axis] + 1 < n[axis]) visit(c + stride[axis]);
            }
        };
        gas::array<int> holder(static_cast<std::size_t>(stride[2] * nz)), number(holder.size(), -1), reached;
        for (int c = 0; c < stride[2] * nz; ++c) holder[c] = solid.at(centre(c));
        const auto reach = [&](int c) {
            if (holder[c] != solids::gas || number[c] >= 0) return;
            number[c] = 0;
            reached.push_back(c);
        };
        for (int c = 0; c < stride[2]; ++c) reach(c);
        for (std::size_t i = 0; i < reached.size(); ++i) beside(reached[i], reach);
        std::sort(reached.begin(), reached.end());

        gas::array<gas::vector3> points;
        for (int k = 0; k <= nz; ++k)
            for (int j = 0; j <= ny; ++j)
                for (int i = 0; i <= nx; ++i) points.push_back(low + dx * gas::vector3{1.0 * i, 1.0 * j, 1.0 * k});
        gas::array<std::array<int, 8>> cells;
        for (const int c : reached) {
            const int row = nx + 1, up = row * (ny + 1), p = c % nx + row * (c / nx % ny) + up * (c / stride[2]);
            cells.push_back({p, p + 1, p + 1 + row, p + row, p + up, p + 1 + up, p + 1 + row + up, p + row + up});
            double sum = 0;
            beside(c, [&](int other) {
                if (holder[other] != solids::gas)
                    sum += 1 / (dx * dx * solid.gas_share(centre(c), centre(other), holder[other]));
            });
            friction.push_back(sum);
        }
        mesh = gas::mesh(gas::from_hexahedra(std::move(points), cells, [&](int cell, int side) {
            const int level = reached[cell] / stride[2];
            return side == 4 && level == 0 ? "bottom" : side == 5 && level + 1 == nz ? "top" : "side";
        }));
    }
};

/// Laminar flow of constant density and viscosity through such a space, from an even inflow at the bottom.
class resolved_flow {
  public:
    resolved_flow(resolved_space s, double density, double viscosity)
        : space(std::move(s)), density_(density) {
        auto model = std::make_shared<gas::simple_gas>();
        model->constant_density = density;
        model->sutherland = 0;
        model->viscosity_reference = viscosity;
        gas::solver_settings settings;
        settings.gravity = {0, 0, 0};
        settings.energy = settings.turbulence = false;
        settings.tolerance = 1e-5;
        solver = std::make_unique<gas::solver>(space.mesh, model, settings);
        solver->set("side", gas::slip());
        solver->set("top", gas::pressure_outlet(settings.reference_pressure));
        for (const double f : space.friction) solver->bed.exchange.push_back(viscosity * f);
    }
    /// Sets the inflow [m^3/s], scaling the flow that is there.
    void set_inflow(double volume_flow) {
        solver->set("bottom", gas::mass_flow_inlet(density_ * volume_flow, {300}));
        if (inflow_ > 0) {
            const double by = volume_flow / inflow_;
            gas::flow_state& flow = solver->gas.flow;
            for (gas::vector3& w : flow.velocity) w = by * w;
            for (gas::vector3& g : flow.pressure_gradient) g = by * g;
            for (double& f : flow.mass_flux) f *= by;
            for (double& p : flow.pressure) p *= by;
        } else {
            solver->initialise(300);
        }
        inflow_ = volume_flow;
    }
    /// Pressure gradient between two heights, by least squares over the cells [Pa/m].
    double gradient(double from, double to) const {
        double count = 0, z = 0, p = 0, zz = 0, zp = 0;
        for (int c = 0; c < space.mesh.cells(); ++c) {
            const double height = space.mesh.centre[c].z, pressure = solver->gas.flow.pressure[c];
            if (height < from || height > to) continue;
            count += 1;
            z += height;
            p += pressure;
            zz += height * height;
            zp += height * pressure;
        }
        return -(zp - z * p / count) / (zz - z * z / count);
    }

    resolved_space space;
    std::unique_ptr<gas::solver> solver;

  private:
    double density_, inflow_ = 0;
};

/// Drag of creeping flow on a sphere in a simple cubic array over that of Stokes, 3 pi mu d U with the superficial
/// speed, by the pressure drop.  The array's planes of symmetry bound a quarter of a column of three; the middle one
/// counts.  `pitch` over the diameter, `cells` per diameter.  Throws std::runtime_error where the flow does not come to
/// rest.
inline double simple_cubic_drag(double pitch, int cells) {
    constexpr double pi = 3.14159265358979323846, reynolds = 0.01;
    const int half = static_cast<int>(std::lround(0.5 * pitch * cells));
    solids column;
    for (const double z : {0.5, 1.5, 2.5}) {
        column.spheres.positions.push_back({0, 0, z * pitch});
        column.spheres.radii.push_back(0.5);
    }
    const double dx = 0.5 * pitch / half;
    resolved_flow flow(resolved_space(column, {0, 0, 0}, {half, half, 6 * half}, dx), 1, 1 / reynolds);
    flow.set_inflow(0.25 * pitch * pitch);
    const gas::report report = flow.solver->steady();
    if (!report.converged) throw std::runtime_error("simple cubic array: " + report.reason);
    // between the planes of symmetry above and below the middle sphere
    double drop = 0, area = 0;
    const gas::mesh& mesh = flow.space.mesh;
    for (int c = 0; c < mesh.cells(); ++c) {
        const double away = std::abs(mesh.centre[c].z - 1.5 * pitch) - 0.5 * pitch;
        if (std::abs(away) > 0.6 * dx) continue;
        const double sign = mesh.centre[c].z < 1.5 * pitch ? 1 : -1;
        drop += sign * flow.solver->gas.flow.pressure[c];
        area += 0.5;
    }
    return drop / area * pitch * pitch * reynolds / (3 * pi);
}

/// Steady flow of cold air up a resolved bed in a tube: the equations without any closure.  Above a few hundred for the
/// particle Reynolds number the true flow is unsteady and its layers are thinner than cells: what is found then is the
/// drag of shapes, with the friction of an unresolved layer.
class resolved_tube {
  public:
    /// `cells` per diameter.  The bed stands one diameter above the inlet; the gradient is that of its stretch far from
    /// the ends.
    resolved_tube(const tube_bed& bed, int cells)
        : bottom_(bed.from() + bed.diameter),
          top_(bed.to() + bed.diameter),
          area_(3.14159265358979323846 * bed.radius * bed.radius),
          flow_(space_of(bed, cells), blown_gas{}.density, blown_gas{}.viscosity) {}

    struct answer {
        double gradient = 0;  ///< [Pa/m]
        double change = 0;    ///< of the gradient over the last ten iterations, relative [-]
        int iterations = 0;
    };

    /// A superficial speed [m/s], from the speed before where there is one: until the gradient changes by less than
    /// `tolerance` in ten iterations.
    answer blow(double speed, double tolerance = 2e-4, int most = 200) {
        flow_.set_inflow(speed * area_);
        answer result;
        double before = 0;
        while (result.iterations < most) {
            flow_.solver->iterate();
            if (++result.iterations % 10 != 0) continue;
            result.gradient = flow_.gradient(bottom_, top_);
            result.change = std::abs(result.gradient / before - 1);
            if (result.iterations > 10 && result.change < tolerance) break;
            before = result.gradient;
        }
        return result;
    }

    int cells() const { return flow_.space.mesh.cells(); }

  private:
    static resolved_space space_of(const tube_bed& bed, int cells) {
        const double dx = bed.diameter / cells;
        solids solid{bed.spheres, bed.radius};
        for (point& x : solid.spheres.positions) x[2] += bed.diameter;
        const int half = static_cast<int>(std::ceil(bed.radius / dx)) + 1;
        const int levels = static_cast<int>(std::ceil((bed.top + 2.5 * bed.diameter) / dx));
        return {solid, {-half * dx, -half * dx, 0}, {2 * half, 2 * half, levels}, dx};
    }

    double bottom_, top_, area_;
    resolved_flow flow_;
};

}  // namespace hearth::test
