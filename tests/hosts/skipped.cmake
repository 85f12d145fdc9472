# SPDX-License-Identifier: MIT
# Where no host is installed: configuring says so and each host has a test that is reported as skipped; where hosts are
# required, configuring fails.  cmake -D source=... -D scratch=... -D cxx=... -D c=... -P skipped.cmake
file(REMOVE_RECURSE ${scratch})
set(hosts openfoam liggghts lammps fortran)
function(configure)
    # Nothing below /usr is found; compilers are named, but for Fortran, which is not there.
    execute_process(COMMAND ${CMAKE_COMMAND} -E env FC=/nonexistent ${CMAKE_COMMAND} -S ${source} -B ${scratch}
            -D CMAKE_CXX_COMPILER=${cxx} -D CMAKE_C_COMPILER=${c} -D "CMAKE_IGNORE_PREFIX_PATH=/;/usr;/usr/local"
            -D HEARTH_HOSTS=ON -D HEARTH_MPI=OFF -D HEARTH_TESTS=OFF -D HEARTH_EXAMPLES=OFF ${ARGN}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    string(REGEX REPLACE "[ \n]+" " " output "${output}")
    set(status ${status} PARENT_SCOPE)
    set(output "${output}" PARENT_SCOPE)
endfunction()

configure()
if(NOT status EQUAL 0)
    message(FATAL_ERROR "without hosts, configuring fails: ${output}")
endif()
execute_process(COMMAND ${CMAKE_CTEST_COMMAND} -R "^hosts/(openfoam|liggghts|lammps|fortran)$" WORKING_DIRECTORY ${scratch}
    OUTPUT_VARIABLE tests ERROR_VARIABLE tests)
foreach(host IN LISTS hosts)
    if(NOT output MATCHES "host ${host} is skipped: [^:]+\\(Debian: ")
        message(FATAL_ERROR "${host} is skipped without a word: ${output}")
    endif()
    if(NOT tests MATCHES "hosts/${host} \\.+\\*\\*\\*Skipped")
        message(FATAL_ERROR "${host} has no skipped test: ${tests}")
    endif()
endforeach()

configure(-D HEARTH_HOSTS_REQUIRED=ON)
if(status EQUAL 0 OR NOT output MATCHES "host openfoam: OpenFOAM is not installed \\(Debian: openfoam\\)")
    message(FATAL_ERROR "required hosts are missing, and configuring says: ${output}")
endif()
