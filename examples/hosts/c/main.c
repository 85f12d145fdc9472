/* SPDX-License-Identifier: MIT */
/* A C program that calls hearth: spheres larger than the cells of a cube, their solid fraction, and two closures. */
#include "hearth.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define N 12
#define CELLS (N * N * N)
#define FACES (3 * N * N * (N - 1))

static const double spacing = 0.001, pi = 3.14159265358979323846; /* [m] */

static int owner[FACES], neighbour[FACES];
static double areas[FACES], conductances[FACES], volumes[CELLS], centres[3 * CELLS], solid_fraction[CELLS];

/* As C programs like to have them: all of a particle together. */
struct particle {
    double mass, position[3], diameter, radius;
};

static hearth_mesh make_cube(void) {
    const int step[3] = {1, N, N * N};
    int faces = 0, c, a;
    hearth_mesh mesh;
    for (c = 0; c < CELLS; ++c) {
        const int at[3] = {c % N, c / N % N, c / (N * N)};
        volumes[c] = spacing * spacing * spacing;
        for (a = 0; a < 3; ++a) {
            centres[3 * c + a] = (at[a] + 0.5) * spacing;
            if (at[a] + 1 == N) continue;
            owner[faces] = c;
            neighbour[faces] = c + step[a];
            areas[faces] = spacing * spacing;
            conductances[faces++] = spacing;
        }
    }
    mesh.cell_count = CELLS;
    mesh.face_count = faces;
    mesh.owner = owner;
    mesh.neighbour = neighbour;
    mesh.areas = areas;
    mesh.conductances = conductances;
    mesh.volumes = volumes;
    mesh.centres = centres;
    return mesh;
}

static int check(int holds, const char* what) {
    if (!holds) printf("FAILED: %s\n", what);
    return holds ? 0 : 1;
}

/* Solid volume [m^3] and largest fraction [-]. */
static double solid(double* largest) {
    double sum = 0;
    int c;
    for (*largest = 0, c = 0; c < CELLS; ++c) {
        sum += solid_fraction[c] * volumes[c];
        *largest = fmax(*largest, solid_fraction[c]);
    }
    return sum;
}

int main(void) {
    const struct particle spheres[2] = {{1e-6, {0.0061, 0.0058, 0.0043}, 0.0024, 0.0012},
                                        {1e-6, {0.0059, 0.0063, 0.0060}, 0.0036, 0.0018}};
    const double expected = 4.0 / 3.0 * pi * (pow(0.0012, 3) + pow(0.0018, 3));
    const hearth_mesh mesh = make_cube();
    hearth_particles particles;
    hearth_message message;
    double largest, before;
    int wrong = 0;

    particles.count = 2;
    particles.positions = spheres[0].position;
    particles.position_stride = sizeof(struct particle) / sizeof(double);
    particles.radii = &spheres[0].radius;
    particles.radius_stride = particles.position_stride;
    wrong += check(hearth_deposit(&mesh, &particles, solid_fraction, &message) == 0, message.text);
    before = solid(&largest);
    /* CELLS sums of round-off. */
    wrong += check(fabs(before - expected) < 4e-13 * expected, "the deposit keeps the volume of the spheres");

    solid_fraction[5] = 3; /* more than fits */
    before = solid(&largest);
    wrong += check(hearth_smooth(&mesh, 0.7, solid_fraction, &message) == 0, message.text);
    wrong += check(fabs(solid(&largest) - before) < 4e-13 * before, "the smoother keeps the volume");
    wrong += check(largest <= 0.7, "no cell is above the threshold");
    printf("solid volume %.6g m^3, largest fraction %.3f\n", before, largest);

    /* A radius of nothing is refused with a sentence, and the field stays. */
    {
        struct particle bad[1];
        memcpy(bad, spheres, sizeof bad);
        bad[0].radius = -1;
        particles.count = 1;
        particles.positions = bad[0].position;
        particles.radii = &bad[0].radius;
        before = solid(&largest);
        wrong += check(hearth_deposit(&mesh, &particles, solid_fraction, &message) == 1, "a bad radius is refused");
        wrong += check(strstr(message.text, "radius") != NULL && solid(&largest) == before, "with a sentence");
        printf("%s\n", message.text);
    }

    /* By hand: Nu = 7 - 10 e + 5 e^2 at rest; Ergun's two terms at e = 0.4, 1 m/s, 1 kg/m^3, 1e-5 Pa s, 10 mm:
     * 150 0.36 1e-5 / (0.064 1e-4) = 84.375 and 1.75 0.6 / (0.064 0.01) = 1640.625 Pa/m. */
    wrong += check(fabs(hearth_gunn_nusselt(0.4, 0, 0.7) - 3.8) < 1e-14, "Gunn at rest");
    wrong += check(fabs(hearth_ergun_gradient(0.4, 1, 1, 1e-5, 0.01) - 1725.0) < 1e-11, "Ergun");
    return wrong;
}
