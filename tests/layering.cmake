# SPDX-License-Identifier: MIT
# Who may include whom.  cmake -D root=SOURCE_DIR -D scratch=EMPTY_DIR -P layering.cmake
#
#             adapt   mpi   eigen            (adapt: transfer, too)
#                \     |     /
#  scene -> transfer, voidage, time -> closure -> core -> the standard library
#  furnace -> dem, gas, combustion -> io, all of the above; the three never include one another
#
# An arrow means "may include".  A rule is a folder and a regular expression of what its files may include.
set(numbers "core/(scalar|interval|constants|function|error|assert)\\.hpp")  # a closure never sees a mesh
set(library "(core|closure|voidage|transfer|time|scene|mpi)/|(eigen|version)\\.hpp")
set(rules
    "include/hearth/core       core/"
    "include/hearth/closure    closure/|${numbers}"
    "include/hearth/voidage    (voidage|closure|core)/"
    "include/hearth/transfer   (transfer|closure|core)/"
    "include/hearth/time       (time|closure|core)/"
    "include/hearth/scene      (scene|transfer|voidage|time|closure|core)/"
    "include/hearth/mpi        (mpi|core)/|<mpi\\.h>"
    "include/hearth/adapt      (adapt|transfer|core)/|<mpi\\.h>|FOREIGN"
    "include/hearth/eigen.hpp  core/|<(unsupported/)?Eigen/"
    "include/hearth/hearth.hpp (core|closure|voidage|transfer|time|scene)/|adapt/raw\\.hpp|version\\.hpp"
    "include/hearth/version.hpp NOTHING"
    "examples/solvers/io         ${library}|io/|FOREIGN"
    "examples/solvers/dem        ${library}|(dem|io)/|FOREIGN"
    "examples/solvers/gas        ${library}|(gas|io)/|FOREIGN"
    "examples/solvers/combustion ${library}|(combustion|io)/|FOREIGN")

# Sets `out` to the list of violations in a source tree.
function(violations tree out)
    set(found)
    file(GLOB_RECURSE unruled RELATIVE ${tree} ${tree}/include/hearth/*)
    foreach(rule IN LISTS rules)
        string(REGEX MATCH "^([^ ]+) +(.+)$" match "${rule}")
        set(folder ${CMAKE_MATCH_1})
        set(allowed ${CMAKE_MATCH_2})
        file(GLOB_RECURSE files RELATIVE ${tree} ${tree}/${folder} ${tree}/${folder}/*.hpp ${tree}/${folder}/*.cpp)
        list(REMOVE_ITEM unruled ${files})
        foreach(file IN LISTS files)
            file(STRINGS ${tree}/${file} includes REGEX "^[ \t]*#[ \t]*include")
            foreach(line IN LISTS includes)
                string(REGEX MATCH "[<\"].*[>\"]" header "${line}")
                if(header MATCHES "^<([a-z0-9_]+)>$")
                    continue()  # the standard library
                elseif(header MATCHES "^[<\"]hearth/(.*)[>\"]$")
                    set(header ${CMAKE_MATCH_1})
                elseif(allowed MATCHES "FOREIGN")
                    continue()
                endif()
                if(NOT header MATCHES "^(${allowed})")
                    list(APPEND found "${file}: ${folder} may not include ${header}")
                endif()
            endforeach()
        endforeach()
    endforeach()
    foreach(file IN LISTS unruled)
        list(APPEND found "${file}: no rule says what it may include")
    endforeach()
    set(${out} ${found} PARENT_SCOPE)
endfunction()

# The check itself is checked on planted violations: each of these, and nothing else, must be found.
file(REMOVE_RECURSE ${scratch})
set(expected)
macro(plant file header)
    file(APPEND ${scratch}/${file} "#include <vector>\n  #  include ${header}\n")
    if(${ARGC} GREATER 2)
        list(APPEND expected "${file}: ${ARGV2}")
    endif()
endmacro()
plant(include/hearth/closure/a.hpp "<hearth/scene/scene.hpp>" "include/hearth/closure may not include scene/scene.hpp")
plant(include/hearth/closure/b.hpp "<hearth/core/mesh_traits.hpp>"
    "include/hearth/closure may not include core/mesh_traits.hpp")
plant(include/hearth/closure/c.hpp "<hearth/core/scalar.hpp>")
plant(include/hearth/core/d.hpp "<mpi.h>" "include/hearth/core may not include <mpi.h>")
plant(include/hearth/core/e.hpp "\"../voidage/vfs.hpp\"" "include/hearth/core may not include \"../voidage/vfs.hpp\"")
plant(include/hearth/hearth.hpp "<hearth/mpi/halo.hpp>"
    "include/hearth/hearth.hpp may not include mpi/halo.hpp")
plant(include/hearth/mpi/f.hpp "<mpi.h>")
plant(include/hearth/mpi/g.hpp "<Eigen/Core>" "include/hearth/mpi may not include <Eigen/Core>")
plant(include/hearth/time/h.hpp "<hearth/transfer/drag.hpp>" "include/hearth/time may not include transfer/drag.hpp")
plant(examples/solvers/gas/i.cpp "<hearth/dem/bed.hpp>" "examples/solvers/gas may not include dem/bed.hpp")
plant(include/hearth/misc/k.hpp "<vector>")
list(APPEND expected "include/hearth/misc/k.hpp: no rule says what it may include")
plant(examples/solvers/gas/j.cpp "<Eigen/Core>")
violations(${scratch} planted)
list(SORT planted)
list(SORT expected)
if(NOT planted STREQUAL expected)
    message(FATAL_ERROR "The check misses or invents a violation.\nexpected: ${expected}\nfound:    ${planted}")
endif()

violations(${root} found)

# hearth.hpp is everything that needs only the standard library.
file(READ ${root}/include/hearth/hearth.hpp umbrella)
file(GLOB_RECURSE headers RELATIVE ${root}/include ${root}/include/hearth/*.hpp)
list(FILTER headers EXCLUDE REGEX "^hearth/(hearth|eigen|mpi/.*|adapt/(openfoam|liggghts|lammps))\\.hpp$")
foreach(header IN LISTS headers)
    string(FIND "${umbrella}" "#include <${header}>" position)
    if(position EQUAL -1)
        list(APPEND found "include/hearth/hearth.hpp does not include <${header}>")
    endif()
endforeach()

list(JOIN found "\n" text)
if(found)
    message(FATAL_ERROR "${text}")
endif()
