! SPDX-License-Identifier: MIT
! A Fortran program that calls hearth: spheres larger than the cells of a cube, their solid fraction, and two closures.
program main
    use hearth
    implicit none
    integer, parameter :: n = 12, cells = n**3, most_faces = 3 * n**2 * (n - 1)
    real(c_double), parameter :: spacing = 1e-3_c_double, pi = 3.14159265358979323846_c_double  ! [m]
    integer(c_int), target :: owner(most_faces), neighbour(most_faces)
    real(c_double), target :: areas(most_faces), conductances(most_faces), volumes(cells), centres(3, cells)
    real(c_double), target :: positions(3, 2), radii(2)
    real(c_double) :: solid_fraction(cells), solid, expected
    type(hearth_mesh) :: mesh
    type(hearth_particles) :: particles
    type(hearth_message) :: message
    integer :: i, j, k, c, faces
    logical :: right

    faces = 0
    do k = 0, n - 1
        do j = 0, n - 1
            do i = 0, n - 1
                c = i + n * (j + n * k)
                centres(:, c + 1) = ([i, j, k] + 0.5_c_double) * spacing
                if (i + 1 < n) call add_face(c, c + 1)
                if (j + 1 < n) call add_face(c, c + n)
                if (k + 1 < n) call add_face(c, c + n * n)
            end do
        end do
    end do
    areas = spacing**2
    conductances = spacing
    volumes = spacing**3
    mesh = hearth_mesh(cells, faces, c_loc(owner), c_loc(neighbour), c_loc(areas), c_loc(conductances), c_loc(volumes), &
                       c_loc(centres))

    positions = reshape([0.0061_c_double, 0.0058_c_double, 0.0043_c_double, &
                         0.0059_c_double, 0.0063_c_double, 0.0060_c_double], [3, 2])
    radii = [0.0012_c_double, 0.0018_c_double]
    particles = hearth_particles(2_c_long, c_loc(positions), 3_c_ptrdiff_t, c_loc(radii), 1_c_ptrdiff_t)
    expected = 4 * pi / 3 * sum(radii**3)
    solid_fraction = 0

    right = hearth_deposit(mesh, particles, solid_fraction, message) == 0
    solid = sum(solid_fraction * volumes)
    right = right .and. abs(solid - expected) < 4e-13_c_double * expected  ! one round-off a cell

    solid_fraction(6) = 3  ! more than fits
    solid = sum(solid_fraction * volumes)
    right = right .and. hearth_smooth(mesh, 0.7_c_double, solid_fraction, message) == 0
    right = right .and. abs(sum(solid_fraction * volumes) - solid) < 4e-13_c_double * solid
    right = right .and. maxval(solid_fraction) <= 0.7_c_double

    radii(2) = -1  ! refused with a sentence
    right = right .and. hearth_deposit(mesh, particles, solid_fraction, message) == 1
    right = right .and. abs(sum(solid_fraction * volumes) - solid) < 4e-13_c_double * solid
    print '(256a1)', message%text(1:index(transfer(message%text, repeat(' ', 256)), c_null_char) - 1)

    ! By hand, see ../c/main.c.
    right = right .and. abs(hearth_gunn_nusselt(0.4_c_double, 0.0_c_double, 0.7_c_double) - 3.8_c_double) < 1e-14_c_double
    right = right .and. abs(hearth_ergun_gradient(0.4_c_double, 1.0_c_double, 1.0_c_double, 1e-5_c_double, 1e-2_c_double) &
                            - 1725) < 1e-11_c_double
    print '(a,es12.5,a,f6.3)', 'solid volume [m^3]', solid, ', largest fraction', maxval(solid_fraction)
    if (.not. right) error stop 'hearth from Fortran'

contains
    subroutine add_face(a, b)
        integer, intent(in) :: a, b
        faces = faces + 1
        owner(faces) = a
        neighbour(faces) = b
    end subroutine
end program
