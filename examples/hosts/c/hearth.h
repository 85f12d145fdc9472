/* SPDX-License-Identifier: MIT */
/* hearth for C, and with ISO_C_BINDING for Fortran: a small part of it, to copy and extend.  SI units; arrays are the
 * caller's and may have strides; nothing is kept between calls. */
#ifndef HEARTH_C_H
#define HEARTH_C_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh as finite-volume codes hold it: face f lies between the cells owner[f] and neighbour[f], numbered from 0. */
typedef struct {
    int cell_count;
    int face_count;
    const int* owner;
    const int* neighbour;
    const double* areas;        /* of faces [m^2] */
    const double* conductances; /* of faces: area over distance of the centres along the normal [m] */
    const double* volumes;      /* of cells [m^3] */
    const double* centres;      /* x, y, z of each cell in turn [m] */
} hearth_mesh;

/* Particles: element i of a quantity starts at its pointer + i * stride, strides in doubles. */
typedef struct {
    long count;
    const double* positions; /* x, y, z of each [m] */
    ptrdiff_t position_stride;
    const double* radii; /* [m] */
    ptrdiff_t radius_stride;
} hearth_particles;

/* Room for the sentence that says what was wrong; empty after success. */
typedef struct {
    char text[256];
} hearth_message;

/* All functions return 0, or 1 and a message; the field is then as it was.  solid_fraction has one element per cell [-]. */

/* Volume of the particles over the volume of each cell, spread over the cells that a particle overlaps. */
int hearth_deposit(const hearth_mesh* mesh, const hearth_particles* particles, double* solid_fraction,
                   hearth_message* message);

/* Volume Fraction Smoother: gives what is above the threshold in (0, 1] to the neighbours; keeps the solid volume. */
int hearth_smooth(const hearth_mesh* mesh, double threshold, double* solid_fraction, hearth_message* message);

/* Nusselt number of a particle in a bed, after Gunn (1978); Reynolds number on the superficial slip [-]. */
double hearth_gunn_nusselt(double void_fraction, double reynolds, double prandtl);

/* -dp/dx of a bed of spheres, after Ergun (1952) [Pa/m]; superficial velocity [m/s]. */
double hearth_ergun_gradient(double void_fraction, double superficial_velocity, double density, double viscosity,
                             double diameter);

#ifdef __cplusplus
}
#endif

#endif
