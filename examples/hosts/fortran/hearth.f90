! SPDX-License-Identifier: MIT
! What ../c/hearth.h declares, for Fortran.  Cells are numbered from 0 in owner and neighbour.
module hearth
    use, intrinsic :: iso_c_binding
    implicit none

    type, bind(c) :: hearth_mesh
        integer(c_int) :: cell_count, face_count
        type(c_ptr) :: owner, neighbour, areas, conductances, volumes, centres
    end type

    type, bind(c) :: hearth_particles
        integer(c_long) :: count
        type(c_ptr) :: positions
        integer(c_ptrdiff_t) :: position_stride
        type(c_ptr) :: radii
        integer(c_ptrdiff_t) :: radius_stride
    end type

    type, bind(c) :: hearth_message
        character(kind=c_char) :: text(256)
    end type

    interface
        integer(c_int) function hearth_deposit(mesh, particles, solid_fraction, message) bind(c)
            import
            type(hearth_mesh), intent(in) :: mesh
            type(hearth_particles), intent(in) :: particles
            real(c_double), intent(inout) :: solid_fraction(*)
            type(hearth_message), intent(out) :: message
        end function
        integer(c_int) function hearth_smooth(mesh, threshold, solid_fraction, message) bind(c)
            import
            type(hearth_mesh), intent(in) :: mesh
            real(c_double), value :: threshold
            real(c_double), intent(inout) :: solid_fraction(*)
            type(hearth_message), intent(out) :: message
        end function
        real(c_double) function hearth_gunn_nusselt(void_fraction, reynolds, prandtl) bind(c)
            import
            real(c_double), value :: void_fraction, reynolds, prandtl
        end function
        real(c_double) function hearth_ergun_gradient(void_fraction, superficial_velocity, density, viscosity, diameter) &
            bind(c)
            import
            real(c_double), value :: void_fraction, superficial_velocity, density, viscosity, diameter
        end function
    end interface
end module
