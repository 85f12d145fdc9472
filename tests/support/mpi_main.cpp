// SPDX-License-Identifier: MIT
// Runs the test cases on every rank and fails on every rank if any failed.  Only rank 0 prints its summary; a failed
// check is printed by the rank that found it.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <mpi.h>

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1  // as GCC says it
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#define LEAKS(action) __lsan_##action()
#else
#define LEAKS(action)
#endif

int main(int argc, char** argv) {
    LEAKS(disable);  // what MPI keeps is not ours to free
    MPI_Init(&argc, &argv);
    LEAKS(enable);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    doctest::Context context(argc, argv);
    context.setOption("minimal", rank != 0);
    int failed = context.run();
    MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    LEAKS(do_leak_check);  // before MPI unloads the libraries by whose names its own leaks are known
    MPI_Finalize();
    return failed;
}
