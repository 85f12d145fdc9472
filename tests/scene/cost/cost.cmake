# SPDX-License-Identifier: MIT
# The cold bed by a scene costs what it costs by hand.
# cmake -D program=... -D object=... -D nm=... -D valgrind=... -D flags=... -P cost.cmake
if(flags MATCHES "fsanitize|coverage")
    message("skipped: instrumented code is not what is counted")
    return()
endif()

execute_process(COMMAND ${nm} --undefined-only ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(symbols MATCHES "(pow|exp|exp2|log|cbrt|fourth)[fl]?[@\n]")
    message(FATAL_ERROR "a cold scene has no powers, but its object refers to:\n${symbols}")
endif()

execute_process(COMMAND ${program} COMMAND_ERROR_IS_FATAL ANY)
if(NOT valgrind)
    message("skipped: no valgrind to count instructions")
    return()
endif()
function(count_instructions result function)
    execute_process(COMMAND ${valgrind} --tool=callgrind --callgrind-out-file=/dev/null
        "--toggle-collect=cost::${function}(*" ${program} OUTPUT_QUIET ERROR_VARIABLE report COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "Collected : ([0-9]+)" found "${report}")
    if(NOT found)
        message("skipped: valgrind counted nothing:\n${report}")
        return()
    endif()
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()
count_instructions(by_scene by_scene)
count_instructions(by_hand by_hand)
if(NOT by_scene OR NOT by_hand)
    return()
endif()
message("instructions by scene ${by_scene}, by hand ${by_hand}")
# Counts are exact and repeatable.  One of a hundred is left to the compiler, which orders the same arithmetic differently.
math(EXPR allowed "${by_hand} + ${by_hand} / 100")
if(by_scene GREATER allowed)
    message(FATAL_ERROR "the scene takes more instructions than the loop by hand")
endif()
