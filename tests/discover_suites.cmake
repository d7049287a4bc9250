# SPDX-License-Identifier: MIT
# cmake -DPROGRAM=<program> -DPROPERTIES=<name;value;...> -DOUTPUT=<file> -P discover_suites.cmake
# Writes a CTest test for each suite of a GoogleTest program.
cmake_policy(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
# A suite's line begins with its name and a point; the lines of its tests are indented.
string(REGEX MATCHALL "\n[^ \n]+\\." names "\n${listing}")
if(NOT names)
    message(FATAL_ERROR "${PROGRAM} lists no tests")
endif()
list(JOIN PROPERTIES " " properties)
set(text "")
foreach(name IN LISTS names)
    string(REGEX REPLACE "^\n(.*)\\.$" "\\1" suite "${name}")
    string(APPEND text "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
           "set_tests_properties([=[${suite}]=] PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
