// SPDX-License-Identifier: MIT
// Mesh files in text put every element on a line of its own. Many programs write and read words without
// regard to lines.
#pragma once
#include "metamarch/error/error.h"

namespace metamarch {

// Returns what `read(false)` reads by lines or, where that is refused, what `read(true)` reads by words.
// Where both are refused, throws the refusal of the lines, which says more.
template <class Read>
auto readLinesElseWords(const Read& read) {
    try {
        return read(false);
    } catch (const Error& refusal) {
        if (refusal.kind != ErrorKind::inputRefused) {
            throw;
        }
        try {
            return read(true);
        } catch (const Error&) { // NOLINT(bugprone-empty-catch): see above
        }
        throw;
    }
}

} // namespace metamarch
