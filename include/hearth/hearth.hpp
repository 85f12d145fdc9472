// SPDX-License-Identifier: MIT
#pragma once

/// Everything that needs only the standard library.  Of the rest, include what you use:
///     <hearth/eigen.hpp>       closures on Eigen's lanes and dual numbers
///     <hearth/mpi/...>         ranks; link hearth::mpi
///     <hearth/adapt/...>       the traits of a host; include only yours

#include <hearth/version.hpp>

#include <hearth/core/agree.hpp>
#include <hearth/core/assert.hpp>
#include <hearth/core/cell_bins.hpp>
#include <hearth/core/cell_graph.hpp>
#include <hearth/core/cell_locator.hpp>
#include <hearth/core/communicator.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/contact_traits.hpp>
#include <hearth/core/csr_graph.hpp>
#include <hearth/core/element.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/face_mesh.hpp>
#include <hearth/core/find_cell.hpp>
#include <hearth/core/function.hpp>
#include <hearth/core/graph_builder.hpp>
#include <hearth/core/halo.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/lane_math.hpp>
#include <hearth/core/lattice.hpp>
#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/particle_halo.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/core/quantity.hpp>
#include <hearth/core/remote_faces.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/core/scalar.hpp>
#include <hearth/core/strided_cloud.hpp>
#include <hearth/core/thermal_link.hpp>
#include <hearth/core/unique_ids.hpp>

#include <hearth/closure/air.hpp>
#include <hearth/closure/beetstra.hpp>
#include <hearth/closure/checked.hpp>
#include <hearth/closure/di_felice.hpp>
#include <hearth/closure/drag.hpp>
#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/ergun_wen_yu.hpp>
#include <hearth/closure/evaporation.hpp>
#include <hearth/closure/feng_han.hpp>
#include <hearth/closure/gas_film.hpp>
#include <hearth/closure/gidaspow.hpp>
#include <hearth/closure/grey_exchange.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/hertz.hpp>
#include <hearth/closure/intraparticle.hpp>
#include <hearth/closure/quadrature.hpp>
#include <hearth/closure/ranz_marshall.hpp>
#include <hearth/closure/sphere_pair.hpp>
#include <hearth/closure/wakao_kaguei.hpp>
#include <hearth/closure/wall_view.hpp>
#include <hearth/closure/wen_yu.hpp>
#include <hearth/closure/zhang.hpp>

#include <hearth/voidage/chebyshev.hpp>
#include <hearth/voidage/columns.hpp>
#include <hearth/voidage/deposit.hpp>
#include <hearth/voidage/filtered_fraction.hpp>
#include <hearth/voidage/filtered_fraction_settings.hpp>
#include <hearth/voidage/footprints.hpp>
#include <hearth/voidage/four.hpp>
#include <hearth/voidage/kernel_smoother.hpp>
#include <hearth/voidage/lattice_stencil.hpp>
#include <hearth/voidage/transfer_operator.hpp>
#include <hearth/voidage/vfs.hpp>
#include <hearth/voidage/vfs_cells.hpp>
#include <hearth/voidage/vfs_completion.hpp>
#include <hearth/voidage/vfs_directory.hpp>
#include <hearth/voidage/vfs_log.hpp>
#include <hearth/voidage/vfs_regions.hpp>
#include <hearth/voidage/vfs_replay.hpp>
#include <hearth/voidage/vfs_wave.hpp>
#include <hearth/voidage/visitors.hpp>

#include <hearth/transfer/conduction.hpp>
#include <hearth/transfer/convection.hpp>
#include <hearth/transfer/drag.hpp>
#include <hearth/transfer/links.hpp>
#include <hearth/transfer/radiation.hpp>
#include <hearth/transfer/species.hpp>
#include <hearth/transfer/sphere_contacts.hpp>
#include <hearth/transfer/term.hpp>

#include <hearth/time/acceleration_switch.hpp>
#include <hearth/time/advance.hpp>
#include <hearth/time/caloric.hpp>
#include <hearth/time/drying_step.hpp>
#include <hearth/time/gas_exchange.hpp>
#include <hearth/time/limits.hpp>
#include <hearth/time/network_input.hpp>
#include <hearth/time/network_islands.hpp>
#include <hearth/time/network_solver.hpp>
#include <hearth/time/particle_energy.hpp>
#include <hearth/time/thermal_network.hpp>
#include <hearth/time/through_flow.hpp>
#include <hearth/time/tssm.hpp>
#include <hearth/time/tssm_error.hpp>
#include <hearth/time/tssm_ledger.hpp>

#include <hearth/scene/build_links.hpp>
#include <hearth/scene/needs.hpp>
#include <hearth/scene/scene.hpp>

#include <hearth/adapt/raw.hpp>
