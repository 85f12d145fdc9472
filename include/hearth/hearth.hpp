// SPDX-License-Identifier: MIT
#pragma once

/// Everything that needs only the standard library.  Of the rest, include what you use:
///     <hearth/eigen.hpp>       closures on Eigen's lanes and dual numbers
///     <hearth/mpi/...>         ranks; link hearth::mpi
///     <hearth/adapt/...>       the traits of a host; include only yours

#include <hearth/version.hpp>

#include <hearth/core/agree.hpp>
#include <hearth/core/assert.hpp>
#include <hearth/core/cell_graph.hpp>
#include <hearth/core/communicator.hpp>
#include <hearth/core/conformance.hpp>
#include <hearth/core/constants.hpp>
#include <hearth/core/contact_traits.hpp>
#include <hearth/core/csr_graph.hpp>
#include <hearth/core/error.hpp>
#include <hearth/core/face_mesh.hpp>
#include <hearth/core/function.hpp>
#include <hearth/core/graph_builder.hpp>
#include <hearth/core/halo.hpp>
#include <hearth/core/interval.hpp>
#include <hearth/core/lattice.hpp>
#include <hearth/core/mesh_traits.hpp>
#include <hearth/core/particle_traits.hpp>
#include <hearth/core/quantity.hpp>
#include <hearth/core/remote_faces.hpp>
#include <hearth/core/reproducible_sum.hpp>
#include <hearth/core/scalar.hpp>
#include <hearth/core/strided_cloud.hpp>

#include <hearth/closure/beetstra.hpp>
#include <hearth/closure/di_felice.hpp>
#include <hearth/closure/drag.hpp>
#include <hearth/closure/eisfeld_schnitzlein.hpp>
#include <hearth/closure/ergun.hpp>
#include <hearth/closure/ergun_wen_yu.hpp>
#include <hearth/closure/gidaspow.hpp>
#include <hearth/closure/gunn.hpp>
#include <hearth/closure/ranz_marshall.hpp>
#include <hearth/closure/wakao_kaguei.hpp>
#include <hearth/closure/wen_yu.hpp>





