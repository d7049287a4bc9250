#pragma once
#include "error.h"

#include <gtest/gtest.h>

#include <string>

namespace metamarch {

// Runs `action` and returns the line of the Error it must throw, whose code must be `code`.
template <typename Action>
std::string lineOfError(ExitCode code, const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, code) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

} // namespace metamarch
