# SPDX-License-Identifier: MIT
# One case of code that must not compile.
# cmake -D compiler=c++ "-D flags=-std=c++17;-I..." -D source=CASE.cpp -P must_not_compile.cmake
#
# The case's second line is `// error: SENTENCE`.  The compiler must refuse it with exactly one error, and that error
# must hold the sentence.  With -DMENDED, which supplies what was missing, the same file must compile.
file(READ ${source} text)
string(REGEX MATCH "// error: ([^\n]*)" sentence "${text}")
set(sentence "${CMAKE_MATCH_1}")
if(NOT sentence)
    message(FATAL_ERROR "${source} does not say which error it expects: // error: SENTENCE")
endif()

execute_process(COMMAND ${compiler} ${flags} -fsyntax-only ${source}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(status EQUAL 0)
    message(FATAL_ERROR "${source} compiles, but must be refused with: ${sentence}")
endif()
string(FIND "${output}" "${sentence}" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${source} must be refused with: ${sentence}\nbut the compiler says:\n${output}")
endif()
string(REGEX MATCHALL "error: " errors "${output}")
list(LENGTH errors count)
if(NOT count EQUAL 1)
    message(FATAL_ERROR "${source} must be refused with one error, not ${count}:\n${output}")
endif()

execute_process(COMMAND ${compiler} ${flags} -DMENDED -fsyntax-only ${source} COMMAND_ERROR_IS_FATAL ANY)
