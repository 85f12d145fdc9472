// SPDX-License-Identifier: MIT
// The functions of hearth.h: C's arrays become hearth's views, exceptions become messages.
#include "hearth.h"

#include <cstdio>
#include <exception>

#include <hearth/adapt/raw.hpp>
#include <hearth/closure/drag.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/voidage/deposit.hpp>
#include <hearth/voidage/vfs.hpp>

namespace {

hearth::face_mesh<> view(const hearth_mesh& m) {
    return {m.cell_count, m.face_count, m.owner, m.neighbour, m.areas, m.conductances, m.volumes, m.centres};
}

template <class Call>
int guarded(hearth_message* message, Call&& call) {
    message->text[0] = '\0';
    try {
        call();
        return 0;
    } catch (const std::exception& error) {
        std::snprintf(message->text, sizeof message->text, "%s", error.what());
        return 1;
    }
}

}  // namespace

int hearth_deposit(const hearth_mesh* mesh, const hearth_particles* particles, double* solid_fraction,
                   hearth_message* message) {
    return guarded(message, [&] {
        hearth::strided_cloud<> cloud;
        cloud.count = particles->count;
        cloud.position = {particles->positions, particles->position_stride};
        cloud.radius = {particles->radii, particles->radius_stride};
        const auto cells = view(*mesh);
        const hearth::cell_graph<> graph(cells);
        const hearth::cell_locator locator(cells, graph);
        hearth::deposit_solid_fraction(locator, cloud, solid_fraction);
    });
}

int hearth_smooth(const hearth_mesh* mesh, double threshold, double* solid_fraction, hearth_message* message) {
    return guarded(message, [&] {
        hearth::strided<double> field{solid_fraction, 1};
        (void)hearth::smooth_volume_fraction(view(*mesh), field, {threshold});
    });
}

double hearth_gunn_nusselt(double void_fraction, double reynolds, double prandtl) {
    return hearth::closure::gunn::nusselt(void_fraction, reynolds, prandtl);
}

double hearth_ergun_gradient(double void_fraction, double superficial_velocity, double density, double viscosity,
                             double diameter) {
    const hearth::closure::bed_flow<double> flow{void_fraction, superficial_velocity / void_fraction, density,
                                                 viscosity, diameter};
    return hearth::closure::pressure_gradient(hearth::closure::ergun{}, flow);
}
