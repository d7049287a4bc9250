# SPDX-License-Identifier: MIT
# cmake -DBUILD=<build folder> -DSOURCE=<repository root> -DPREFIX=<folder> -P package_test.cmake
# Installs the build into an empty PREFIX. The package files must name no folder of the build or of the sources.
cmake_policy(VERSION 3.25)

file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB_RECURSE files ${PREFIX}/*.cmake)
if(NOT files)
    message(FATAL_ERROR "${PREFIX} holds no package files")
endif()
foreach(file IN LISTS files)
    file(READ ${file} text)
    foreach(folder IN ITEMS ${BUILD} ${SOURCE})
        string(FIND "${text}" ${folder} place)
        if(NOT place EQUAL -1)
            message(SEND_ERROR "${file} names ${folder}")
        endif()
    endforeach()
endforeach()
