// SPDX-License-Identifier: MIT
// `metamarch view` of a program without the viewer.
#include "metamarch/cli/view_command.h"
#include "metamarch/error/error.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace metamarch::cli {
namespace {

// Becomes the program with the viewer, if its package is installed beside this one. Returns if it is not.
void becomeProgramWithViewer() {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) {
        return;
    }
    const std::filesystem::path other = own.parent_path().parent_path() / "lib/metamarch/metamarch";
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) {
        words.push_back(word);
    }
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    execv(other.c_str(), arguments.data());
}

} // namespace

void runView(const ViewOptions&) {
    becomeProgramWithViewer();
    throw Error(ErrorKind::noDevice, "this program has no viewer: install the package metamarch-viewer, or "
                                     "build with GLFW, Dear ImGui and "
                                     "glslang (Debian: libglfw3-dev libimgui-dev glslang-dev)");
}

} // namespace metamarch::cli
