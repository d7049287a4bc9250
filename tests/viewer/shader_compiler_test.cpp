// SPDX-License-Identifier: MIT
// Compares shaders that are compiled at run time with those of the build.
#include "fixtures/optimized_path_tracer.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/viewer/shader_compiler.h"
#include "metamarch/viewer/shader_reload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace metamarch::viewer {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(METAMARCH_SOURCE_DIR) / "shaders";

std::string readText(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void replaceIn(const fs::path& file, const std::string& old, const std::string& text) {
    std::string all = readText(file);
    const std::size_t at = all.find(old);
    ASSERT_NE(at, std::string::npos);
    all.replace(at, old.size(), text);
    std::ofstream(file) << all;
}

TEST(ShaderCompiler, makesWhatTheBuildMakes) {
    const ShaderCompiler compiler(kFolder);
    int count = 0;
    for (const Shader& shader : shaders()) {
        if (!shader.traversal.empty() && shader.traversal != traversals().front()) {
            continue;
        }
        const ShaderCompiler::Result made =
            compiler.compile(std::string(shader.kernel), std::string(shader.traversal), shader.memory);
        EXPECT_EQ(made.error, "") << shader.kernel;
        // The pictures of a changed path tracer have the same bits without spirv-opt.
        EXPECT_TRUE(std::ranges::equal(
            shader.kernel == "path" ? tests::optimizedPathTracer(made.spirv) : made.spirv, shader.spirv))
            << shader.kernel << (shader.memory == Memory::texel ? " of texels" : "");
        ++count;
    }
    EXPECT_GE(count, 10);
}

TEST(ShaderCompiler, saysFileAndLineOfAnError) {
    const TemporaryFolder folder;
    fs::copy(kFolder, folder / "shaders", fs::copy_options::recursive);
    const ShaderCompiler compiler(folder / "shaders");
    const auto errorOf = [&] { return compiler.compile("path", "meta_table", Memory::storage).error; };
    EXPECT_EQ(errorOf(), "");

    const fs::path kernel = folder / "shaders/kernels/path.glsl";
    const std::string good = readText(kernel);
    replaceIn(kernel, "void main() {", "void main() { nothing;");
    const auto line =
        1 + std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.find("void main() {")),
                       '\n');
    EXPECT_NE(errorOf().find("kernels/path.glsl:" + std::to_string(line) + ":"), std::string::npos)
        << errorOf();
    std::ofstream(kernel) << good;
    EXPECT_EQ(errorOf(), "");

    // Errors name an included file with an error, and one that is missing.
    std::ofstream(folder / "shaders/lib/shading.glsl", std::ios::app) << "\nnothing;\n";
    EXPECT_NE(errorOf().find("lib/shading.glsl:"), std::string::npos) << errorOf();
    fs::remove(folder / "shaders/lib/shading.glsl");
    EXPECT_NE(errorOf().find("lib/shading.glsl"), std::string::npos) << errorOf();
    EXPECT_NE(errorOf().find("kernels/path.glsl:"), std::string::npos) << errorOf();
}

TEST(ShaderReload, keepsTheShadersThatWereGood) {
    const TemporaryFolder folder;
    fs::copy(kFolder, folder / "shaders", fs::copy_options::recursive);
    ShaderReload reload(folder / "shaders");
    EXPECT_TRUE(reload.overrides().find("path", "kd_stack").empty()); // the program uses the embedded shader
    EXPECT_FALSE(reload.lacks({"kd_stack"}));
    ASSERT_EQ(reload.compile({"kd_stack"}, Memory::storage), "");
    const auto spirv = reload.overrides().find("path", "kd_stack");
    ASSERT_FALSE(spirv.empty());
    EXPECT_FALSE(reload.lacks({"kd_stack"}));
    EXPECT_TRUE(reload.lacks({"kd_stack", "kd_ropes"}));
    const std::vector<std::uint32_t> before(spirv.begin(), spirv.end());
    replaceIn(folder / "shaders/kernels/inspect.glsl", "void main() {", "void main() { nothing;");
    EXPECT_NE(reload.compile({"kd_stack"}, Memory::storage), "");
    EXPECT_TRUE(std::ranges::equal(reload.overrides().find("path", "kd_stack"), before));
}

TEST(ShaderReload, watchesNothingWhereThereIsNoFolder) {
    const TemporaryFolder folder;
    ShaderReload reload(folder / "missing");
    EXPECT_FALSE(reload.hasChanged());
    EXPECT_EQ(reload.folder(), fs::path());
}

} // namespace
} // namespace metamarch::viewer
