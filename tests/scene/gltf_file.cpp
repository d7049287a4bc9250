// SPDX-License-Identifier: MIT
#include "scene/gltf_file.h"

#include "fixtures/expect_error.h"
#include "metamarch/error/error.h"

#include <gtest/gtest.h>

#include <fstream>

namespace metamarch {

std::filesystem::path GltfFile::write(const std::string& name) {
    nlohmann::json written = root;
    if (!root.contains("buffers") && !bytes_.empty()) {
        written["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", bytes_.size()}}};
    }
    writeFile(folder / "scene.bin", std::string(bytes_.begin(), bytes_.end()));
    writeFile(folder / name, written.dump());
    return folder / name;
}

std::string GltfFile::refusal() { return refusalOf(write()); }

void writeFile(const std::filesystem::path& path, const std::string& content) {
    // A new file: ext4 writes one that is emptied and written again to the disk at once, which takes
    // milliseconds.
    std::filesystem::remove(path);
    std::ofstream(path, std::ios::binary) << content;
}

std::string refusalOf(const std::filesystem::path& path) {
    const std::string line = lineOfError(ErrorKind::inputRefused, [&] { loadScene(path); });
    const std::string start = path.string() + ": ";
    EXPECT_TRUE(line.starts_with(start)) << line;
    return line.starts_with(start) ? line.substr(start.size()) : line;
}

} // namespace metamarch
