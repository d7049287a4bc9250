# SPDX-License-Identifier: MIT
# cmake -DSOURCE=<repository root> -DOUTPUT=<header> -P git_commit.cmake
# Run by every build; the header changes, and one file is recompiled, only when the commit does.
cmake_policy(VERSION 3.25)

set(COMMIT "unknown")
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git) # sources unpacked inside another repository are not of its commit
    # safe.directory: in a container the repository often belongs to another user.
    execute_process(
        COMMAND ${GIT} --no-optional-locks -c safe.directory=* describe --always --dirty --abbrev=12 --exclude=*
        WORKING_DIRECTORY ${SOURCE}
        RESULT_VARIABLE result
        OUTPUT_VARIABLE described
        ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(result EQUAL 0)
        set(COMMIT ${described})
    endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT "#define METAMARCH_GIT_COMMIT \"@COMMIT@\"\n")
