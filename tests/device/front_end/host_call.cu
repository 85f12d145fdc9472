// SPDX-License-Identifier: MIT
// Must be refused, see ../CMakeLists.txt.
template <class Real>
Real on_the_host(Real x) {
    return x;
}

__global__ void kernel(double* x) { *x = on_the_host(*x); }
