// Checks the exit code and the words of an Error.
#pragma once
#include "error.h"

#include <gtest/gtest.h>

#include <string>

namespace metamarch {

// `call` must throw an Error with `code` whose line contains `part`.
template <class Call>
void expectError(ExitCode code, const std::string& part, const Call& call) {
    try {
        call();
        ADD_FAILURE() << "no Error; expected one with '" << part << "'";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, code) << error.what();
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

} // namespace metamarch
