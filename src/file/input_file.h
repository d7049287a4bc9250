// The file being imported: where its companions may lie, and the lines its user reads.
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
    // Throws Error(inputRefused) unless the path names a regular file with something in it.
    explicit InputFile(std::filesystem::path path);

    const std::filesystem::path& path() const { return path_; }
    std::vector<unsigned char> read() const;

    // Whether `other`, with symbolic links followed, lies in this file's folder or below it. It need not
    // exist.
    bool isBeside(const std::filesystem::path& other) const;

    // Where a name in this file leads, relative to its folder, and why what lies there may not be read: "is
    // missing"; empty when it may.
    std::filesystem::path companion(const std::string& name) const { return path_.parent_path() / name; }
    std::string whyNotReadable(const std::string& name) const;

    // Both throw one line, "<path>: <what>": Error(inputRefused) and Error(outOfMemory).
    [[noreturn]] void refuse(const std::string& what) const;
    [[noreturn]] void refuseSize(const std::string& what) const;

    // Keeps "<path>: <what>" for Scene::warnings; a line that was there before is not repeated.
    void warn(const std::string& what);
    std::vector<std::string> takeWarnings() { return std::move(warnings_); }

  private:
    std::string line(const std::string& what) const;

    std::filesystem::path path_;
    std::filesystem::path folder_; // canonical
    std::vector<std::string> warnings_;
    std::unordered_set<std::string> warned_;
};

// Nothing when the file cannot be read to its end.
std::optional<std::vector<unsigned char>> readBytes(const std::filesystem::path& path);

// ".png" of "wood.PNG"; empty when there is none.
std::string lowerCaseEnding(const std::filesystem::path& path);

// "mesh 'body'", or "mesh 4" for an element without a name.
std::string elementName(const char* kind, const std::string& name, std::size_t index);

} // namespace metamarch
