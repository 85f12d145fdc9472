# SPDX-License-Identifier: MIT
# Finds OpenFOAM: sets OpenFOAM_MISSING to a sentence, or makes the target OpenFOAM::OpenFOAM.
#
# Debian ships OpenFOAM's programs and libraries without headers.  They are in the source package of the same version,
# which is fetched into the build tree (45 MB, once) unless HEARTH_OPENFOAM_SOURCE names a source tree.
set(HEARTH_OPENFOAM_SOURCE "" CACHE PATH "OpenFOAM's source tree; fetched with apt-get where empty")

set(OpenFOAM_MISSING)
find_program(OpenFOAM_BLOCKMESH blockMesh)
foreach(name OpenFOAM finiteVolume meshTools Pstream)
    find_library(OpenFOAM_${name} ${name})
    if(NOT OpenFOAM_BLOCKMESH OR NOT OpenFOAM_${name})
        set(OpenFOAM_MISSING "OpenFOAM is not installed (Debian: openfoam)")
        return()
    endif()
endforeach()

set(source "${HEARTH_OPENFOAM_SOURCE}")
if(NOT source)
    file(GLOB source ${CMAKE_CURRENT_BINARY_DIR}/openfoam-*/src)
    if(NOT source)
        message(STATUS "Fetching OpenFOAM's headers: apt-get source openfoam")
        execute_process(COMMAND apt-get source openfoam WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
            OUTPUT_QUIET ERROR_VARIABLE problem)
        file(GLOB source ${CMAKE_CURRENT_BINARY_DIR}/openfoam-*/src)
        if(NOT source)
            set(OpenFOAM_MISSING "OpenFOAM's headers are missing: apt-get source openfoam (needs dpkg-dev and a deb-src line): ${problem}")
            return()
        endif()
    endif()
    cmake_path(GET source PARENT_PATH source)
endif()

add_library(OpenFOAM::OpenFOAM INTERFACE IMPORTED GLOBAL)
foreach(part OpenFOAM OSspecific/POSIX finiteVolume meshTools surfMesh fileFormats)
    if(NOT EXISTS ${source}/src/${part}/lnInclude)
        execute_process(COMMAND ${source}/wmake/wmakeLnInclude -s ${source}/src/${part} WORKING_DIRECTORY ${source}
            OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
    endif()
    target_include_directories(OpenFOAM::OpenFOAM SYSTEM INTERFACE ${source}/src/${part}/lnInclude)
endforeach()
# What Debian's build was configured with.
target_compile_definitions(OpenFOAM::OpenFOAM INTERFACE WM_ARCH_OPTION=64 WM_DP WM_LABEL_SIZE=32 NoRepository)
target_link_libraries(OpenFOAM::OpenFOAM INTERFACE
    ${OpenFOAM_finiteVolume} ${OpenFOAM_meshTools} ${OpenFOAM_OpenFOAM} ${OpenFOAM_Pstream})
