# SPDX-License-Identifier: MIT
# cmake -D case=install|found|added|refused -D build= -D scratch= -D source= ... -P package.cmake; see CMakeLists.txt.
set(prefix ${scratch}/prefix)

# The consumer's configure step with the project's compiler; the caller appends definitions.  The flags must be the
# project's: a sanitised library cannot be linked into a program that is not.
set(configure ${CMAKE_COMMAND} -G ${generator} -D CMAKE_CXX_COMPILER=${compiler} -D "CMAKE_CXX_FLAGS=${flags}"
    -D CMAKE_PREFIX_PATH=${prefix} -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)

# Configures, builds and runs a consumer.
function(use program)
    set(folder ${scratch}/${case})
    file(REMOVE_RECURSE ${folder})
    execute_process(COMMAND ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/${program} -B ${folder} ${ARGN}
        COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND ${CMAKE_COMMAND} --build ${folder} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND ${folder}/${program} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Demands that the consumer's configure step fails and says `sentence`.
function(refuse sentence)
    set(folder ${scratch}/refused)
    file(REMOVE_RECURSE ${folder})
    execute_process(COMMAND ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${folder} ${ARGN}
        RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake wraps its messages
    string(FIND "${output}" "${sentence}" position)
    if(status EQUAL 0 OR position EQUAL -1)
        message(FATAL_ERROR "Must be refused with: ${sentence}\nbut ended with ${status}: ${output}")
    endif()
endfunction()

if(case STREQUAL install)
    file(REMOVE_RECURSE ${prefix})
    execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${prefix} COMMAND_ERROR_IS_FATAL ANY)
    # The package must work on another machine and after the source is gone.
    file(GLOB_RECURSE package_files ${prefix}/*.cmake)
    foreach(file IN LISTS package_files)
        file(READ ${file} text)
        string(FIND "${text}" ${source} position)
        if(NOT position EQUAL -1)
            message(FATAL_ERROR "${file} names the source folder ${source}")
        endif()
    endforeach()
    # A second prefix, installed without the component mpi.
    file(REMOVE_RECURSE ${prefix}-without-mpi)
    file(COPY ${prefix}/ DESTINATION ${prefix}-without-mpi)
    file(GLOB_RECURSE mpi_files ${prefix}-without-mpi/*/hearth-mpi*.cmake)
    if(mpi_files)
        file(REMOVE ${mpi_files})
    endif()
elseif(case STREQUAL found)
    use(my_solver)
    if(mpi)
        use(consumer -D how=find_package -D components=mpi)
    endif()
    if(furnace)
        use(my_furnace)
    endif()
    # An optional component that is not there is no error.
    execute_process(COMMAND ${configure} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${scratch}/optional
        -D how=find_package -D optional=mpi -D CMAKE_PREFIX_PATH=${prefix}-without-mpi COMMAND_ERROR_IS_FATAL ANY)
elseif(case STREQUAL added)
    use(consumer -D how=add_subdirectory -D source=${source})
elseif(case STREQUAL refused)
    refuse("hearth was installed without component 'mpi'"
        -D how=find_package -D components=mpi -D CMAKE_PREFIX_PATH=${prefix}-without-mpi)
    refuse("hearth has no component 'smelter'; it has: mpi, furnace" -D how=find_package -D components=smelter)
    refuse("compatible with requested version \"0.0\"" -D how=find_package -D wanted=0.0)
    refuse("compatible with requested version \"1.0\"" -D how=find_package -D wanted=1.0)
    refuse("version: ${version}" -D how=find_package -D wanted=1.0)
endif()
