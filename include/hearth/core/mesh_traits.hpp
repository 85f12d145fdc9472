// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace hearth {

/// A point or vector in space [m].
using point = std::array<double, 3>;

/// How a host's mesh answers hearth.  A host specialises this struct; hearth never changes the mesh.
///
/// Types
///     index     signed integer of the host's cell numbers, 0 <= cell < cell_count
///     scalar    float or double
///
/// Tier 0, cell graph (Volume Fraction Smoother): one of the two lists is enough, for_each_face is preferred
///     index  cell_count(mesh)                                  owned cells of this rank
///     scalar volume(mesh, cell)                                [m^3], > 0
///     void   for_each_neighbour(mesh, cell, visit)             visit(neighbour): owned cells across faces, symmetric
///     void   for_each_face(mesh, visit)                        visit(cell, neighbour, area [m^2], conductance [m])
///
/// Tier 1, located (deposit)
///     Point  centre(mesh, cell)                                [m], anything with [0], [1], [2]
///     index  find_cell(mesh, point)                            optional: owned cell that holds the point, or -1
///                                                              (default: of the cells whose extents hold it, that
///                                                              with the nearest centre; give it where meshes are
///                                                              spread over ranks and the policy is centre)
///     Point  extent(mesh, cell)                                [m], optional: lengths of the cell along x, y, z
///                                                              (default: the cube root of its volume in each)
///     Point  period(mesh)                                      [m], optional: lengths after which the mesh repeats
///                                                              itself along x, y, z; 0 where it does not
///
/// Tier 2, faced (kernel smoother, gas)
///     void   for_each_face(mesh, visit)                        every face between two owned cells once;
///                                                              conductance = area / distance of centres along the normal;
///                                                              several faces between two cells add up, a face of a
///                                                              cell with itself (periodic, one cell wide) is left out
///     void   for_each_boundary_face(mesh, visit)               optional: visit(face, cell, patch, area [m^2])
///
/// Parallel: what a host adds when its mesh is spread over ranks
///     std::int64_t global_index(mesh, cell)                    unique over all ranks and persistent; also useful in
///                                                              serial: results depend on these ids, not on storage
///     void   for_each_remote_face(mesh, visit)                 visit(cell, rank, global index of the cell there, area,
///                                                              conductance); both ranks list the face
///
/// Optional
///     std::uint64_t revision(mesh)                             changes whenever the mesh changes
///     lattice_shape lattice(mesh)                              see lattice.hpp: constant spacing, allows stencils
template <class Mesh, class Enable = void>
struct mesh_traits {
    using not_specialised = void;
};

namespace detail {

/// Stands for any visitor when hearth asks whether a trait member exists.
struct any_visitor {
    template <class... Args>
    void operator()(Args&&...) const {}
};

template <class Mesh>
using traits_of = mesh_traits<std::remove_cv_t<std::remove_reference_t<Mesh>>>;

template <class Traits, class = void>
inline constexpr bool is_specialised_v = true;
template <class Traits>
inline constexpr bool is_specialised_v<Traits, std::void_t<typename Traits::not_specialised>> = false;

template <class Traits, class = void>
struct index_of { using type = std::int64_t; };
template <class Traits>
struct index_of<Traits, std::void_t<typename Traits::index>> { using type = typename Traits::index; };

template <class Traits, class = void>
struct scalar_of { using type = double; };
template <class Traits>
struct scalar_of<Traits, std::void_t<typename Traits::scalar>> { using type = typename Traits::scalar; };

/// True where expression<Traits, Mesh> is well formed.
template <template <class, class> class Expression, class Mesh, class = void>
inline constexpr bool has_v = false;
template <template <class, class> class Expression, class Mesh>
inline constexpr bool has_v<Expression, Mesh, std::void_t<Expression<traits_of<Mesh>, Mesh>>> = true;

template <class T> using index_of_t = typename index_of<T>::type;
template <class M> const M& mesh_value() noexcept;

template <class T, class M> using index_type = typename T::index;
template <class T, class M> using scalar_type = typename T::scalar;
template <class T, class M> using cell_count_call = decltype(T::cell_count(mesh_value<M>()));
template <class T, class M> using volume_call = decltype(T::volume(mesh_value<M>(), index_of_t<T>{}));
template <class T, class M> using neighbour_call =
    decltype(T::for_each_neighbour(mesh_value<M>(), index_of_t<T>{}, any_visitor{}));
template <class T, class M> using face_call = decltype(T::for_each_face(mesh_value<M>(), any_visitor{}));
template <class T, class M> using boundary_face_call =
    decltype(T::for_each_boundary_face(mesh_value<M>(), any_visitor{}));
template <class T, class M> using centre_call = decltype(T::centre(mesh_value<M>(), index_of_t<T>{}));
template <class T, class M> using find_cell_call = decltype(T::find_cell(mesh_value<M>(), point{}));
template <class T, class M> using extent_call = decltype(T::extent(mesh_value<M>(), index_of_t<T>{}));
template <class T, class M> using period_call = decltype(T::period(mesh_value<M>()));
template <class T, class M> using global_index_call = decltype(T::global_index(mesh_value<M>(), index_of_t<T>{}));
template <class T, class M> using remote_face_call =
    decltype(T::for_each_remote_face(mesh_value<M>(), any_visitor{}));
template <class T, class M> using revision_call = decltype(T::revision(mesh_value<M>()));
template <class T, class M> using lattice_call = decltype(T::lattice(mesh_value<M>()));

}  // namespace detail

/// The host's integer and scalar types; std::int64_t and double where the traits lack them.
template <class Mesh> using mesh_index_t = typename detail::index_of<detail::traits_of<Mesh>>::type;
template <class Mesh> using mesh_scalar_t = typename detail::scalar_of<detail::traits_of<Mesh>>::type;

template <class Mesh> inline constexpr bool has_neighbours_v = detail::has_v<detail::neighbour_call, Mesh>;
template <class Mesh> inline constexpr bool has_faces_v = detail::has_v<detail::face_call, Mesh>;
template <class Mesh> inline constexpr bool has_boundary_faces_v = detail::has_v<detail::boundary_face_call, Mesh>;
template <class Mesh> inline constexpr bool has_find_cell_v = detail::has_v<detail::find_cell_call, Mesh>;
template <class Mesh> inline constexpr bool has_extent_v = detail::has_v<detail::extent_call, Mesh>;
template <class Mesh> inline constexpr bool has_period_v = detail::has_v<detail::period_call, Mesh>;
template <class Mesh> inline constexpr bool has_global_index_v = detail::has_v<detail::global_index_call, Mesh>;
template <class Mesh> inline constexpr bool has_remote_faces_v = detail::has_v<detail::remote_face_call, Mesh>;
template <class Mesh> inline constexpr bool has_revision_v = detail::has_v<detail::revision_call, Mesh>;
template <class Mesh> inline constexpr bool has_lattice_v = detail::has_v<detail::lattice_call, Mesh>;

/// Tier 0: enough for the Volume Fraction Smoother.
template <class Mesh>
inline constexpr bool is_cell_graph_v =
    detail::is_specialised_v<detail::traits_of<Mesh>> && detail::has_v<detail::index_type, Mesh> &&
    detail::has_v<detail::scalar_type, Mesh> && detail::has_v<detail::cell_count_call, Mesh> &&
    detail::has_v<detail::volume_call, Mesh> && (has_neighbours_v<Mesh> || has_faces_v<Mesh>);

/// Tier 1: enough to deposit particles.
template <class Mesh>
inline constexpr bool is_located_mesh_v = is_cell_graph_v<Mesh> && detail::has_v<detail::centre_call, Mesh>;

/// Tier 2: enough for the kernel smoother.
template <class Mesh>
inline constexpr bool is_faced_mesh_v = is_cell_graph_v<Mesh> && has_faces_v<Mesh>;

#if defined(__cpp_concepts) && __cpp_concepts >= 201907L
template <class Mesh> concept CellGraph = is_cell_graph_v<Mesh>;
template <class Mesh> concept LocatedMesh = is_located_mesh_v<Mesh>;
template <class Mesh> concept FacedMesh = is_faced_mesh_v<Mesh>;
#endif

/// Fails to compile with one sentence that names the first member that the host's traits lack for tier 0.
template <class Mesh>
constexpr void require_cell_graph() {
    if constexpr (!detail::is_specialised_v<detail::traits_of<Mesh>>) {
        static_assert(detail::is_specialised_v<detail::traits_of<Mesh>>,
                      "hearth: specialise hearth::mesh_traits<Mesh> for your mesh (see core/mesh_traits.hpp)");
    } else if constexpr (!detail::has_v<detail::index_type, Mesh>) {
        static_assert(detail::has_v<detail::index_type, Mesh>, "hearth: mesh_traits<Mesh> lacks  using index = ...;");
    } else if constexpr (!detail::has_v<detail::scalar_type, Mesh>) {
        static_assert(detail::has_v<detail::scalar_type, Mesh>, "hearth: mesh_traits<Mesh> lacks  using scalar = ...;");
    } else if constexpr (!detail::has_v<detail::cell_count_call, Mesh>) {
        static_assert(detail::has_v<detail::cell_count_call, Mesh>,
                      "hearth: mesh_traits<Mesh> lacks  index cell_count(mesh)");
    } else if constexpr (!detail::has_v<detail::volume_call, Mesh>) {
        static_assert(detail::has_v<detail::volume_call, Mesh>,
                      "hearth: mesh_traits<Mesh> lacks  scalar volume(mesh, cell)  [m^3]");
    } else {
        static_assert(has_neighbours_v<Mesh> || has_faces_v<Mesh>,
                      "hearth: mesh_traits<Mesh> lacks  for_each_neighbour(mesh, cell, visit)  or  "
                      "for_each_face(mesh, visit)");
    }
}

/// The same for tier 1.
template <class Mesh>
constexpr void require_located_mesh() {
    require_cell_graph<Mesh>();
    if constexpr (is_cell_graph_v<Mesh>) {
        static_assert(detail::has_v<detail::centre_call, Mesh>,
                      "hearth: mesh_traits<Mesh> lacks  point centre(mesh, cell)  [m]");
    }
}

/// The same for tier 2.
template <class Mesh>
constexpr void require_faced_mesh() {
    require_cell_graph<Mesh>();
    if constexpr (is_cell_graph_v<Mesh>) {
        static_assert(has_faces_v<Mesh>,
                      "hearth: mesh_traits<Mesh> lacks  for_each_face(mesh, visit)  with visit(cell, neighbour, area, "
                      "conductance)");
    }
}

}  // namespace hearth
