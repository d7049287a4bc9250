// SPDX-License-Identifier: MIT
// The file being imported: which companion files it may read, and the errors and warnings about it.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

namespace metamarch {

class InputFile {
  public:
    // Throws Error(inputRefused) unless the path names a regular file that is not empty, or is "-": standard
    // input, which is read here, to its end. Such a file has no companions.
    explicit InputFile(std::filesystem::path path);

    // Bytes that are in memory already; messages call them `name`. They have no companions either. Throws
    // Error(inputRefused) if there are none.
    InputFile(const std::string& name, std::vector<unsigned char> bytes);

    const std::filesystem::path& path() const { return path_; }
    std::vector<unsigned char> read() const;
    bool isInMemory() const { return memory_.has_value(); } // also standard input

    // Whether `other`, after following symbolic links, lies in this file's folder or below it. `other` need
    // not exist.
    bool isBeside(const std::filesystem::path& other) const;

    // companion() resolves a name in this file relative to the file's folder. whyNotReadable() says why that
    // file may not be read ("is missing"); empty if it may.
    // portableName() returns the name with slashes for backslashes, which other systems write, unless the
    // file exists under the name as it is.
    std::filesystem::path companion(const std::string& name) const { return path_.parent_path() / name; }
    std::string whyNotReadable(const std::string& name) const;
    std::string portableName(const std::string& name) const;

    // Adds a file that this one names to files(), which begins with this one.
    void addCompanion(const std::string& name) { files_.push_back(companion(name)); }
    const std::vector<std::filesystem::path>& files() const { return files_; }

    // Both throw "<path>: <what>": refuse() as Error(inputRefused), with the names of settings that the user
    // may change, refuseSize() as Error(outOfMemory). In every message, names and values from the file are
    // cut at kMostQuoted characters: they may be whole payloads.
    static constexpr std::size_t kMostQuoted = 80;
    [[noreturn]] void refuse(const std::string& what, const std::vector<std::string>& settings = {}) const;
    [[noreturn]] void refuseSize(const std::string& what) const;

    // Stores "<path>: <what>" for Scene::warnings. A line that is already stored is not repeated.
    void warn(const std::string& what);
    std::vector<std::string> takeWarnings() { return std::move(warnings_); }

  private:
    std::vector<unsigned char> readStandardInput() const;
    std::string line(const std::string& what) const;

    std::filesystem::path path_;
    std::filesystem::path folder_; // canonical; empty for bytes in memory
    std::vector<std::filesystem::path> files_;
    std::optional<std::vector<unsigned char>> memory_;
    std::vector<std::string> warnings_;
    std::unordered_set<std::string> warned_;
};

// Whether a path stands for standard input.
bool isStandardInput(const std::filesystem::path& path);

// Returns nothing if the file cannot be read completely; errno then says why.
std::optional<std::vector<unsigned char>> readBytes(const std::filesystem::path& path);

// Changes ASCII letters only.
std::string lowerCase(std::string_view text);

// Returns ".png" for "wood.PNG"; empty if the name has no ending.
std::string lowerCaseEnding(const std::filesystem::path& path);

// Returns "mesh 'body'", or "mesh 4" for an element without a name.
std::string elementName(const char* kind, const std::string& name, std::size_t index);

} // namespace metamarch
