// SPDX-License-Identifier: MIT
// What the name of an output stands for.
#pragma once
#include <filesystem>
#include <string>

namespace metamarch {

// Links are followed, also one whose target is not there yet.
struct OutputTarget {
    enum class Kind {
        fresh,      // no such file yet
        file,       // a plain file
        stream,     // a device or a pipe, or a stream of another process below /proc
        descriptor, // a stream that this process has open: "-", /dev/stdout, /dev/stderr, /dev/fd/N
    };

    // Throws Error(outputNotWritable) where nothing can be written to it: a folder, no permission, a stream
    // that is closed.
    explicit OutputTarget(const std::filesystem::path& name);

    bool isStream() const { return kind == Kind::stream || kind == Kind::descriptor; }

    // Throws Error(outputNotWritable): "cannot write NAME: REASON".
    [[noreturn]] void refuse(const std::string& reason) const;

    std::filesystem::path shown; // as the user typed it, for messages
    std::filesystem::path path;  // behind all links
    Kind kind = Kind::fresh;
    int descriptor = -1; // of Kind::descriptor
};

// Whether two names stand for one file or stream, in which one result would spoil the other. Throws what
// OutputTarget throws.
bool isSameOutput(const std::filesystem::path& a, const std::filesystem::path& b);

// Whether the name stands for the standard output of this process. Throws what OutputTarget throws.
bool isStandardOutput(const std::filesystem::path& name);

} // namespace metamarch
