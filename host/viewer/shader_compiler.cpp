// SPDX-License-Identifier: MIT
#include "metamarch/viewer/shader_compiler.h"

#include <fmt/format.h>

#include <fstream>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <iterator>
#include <utility>

namespace metamarch::viewer {
namespace {

constexpr int kGlslVersion = 460;

// Looks for an included file in the folder of the including file, then in `folder`, as glslangValidator -I
// does.
class Includer : public glslang::TShader::Includer {
  public:
    explicit Includer(const std::filesystem::path& folder) : root(folder) {}

    IncludeResult* includeLocal(const char* const name, const char* const includer, std::size_t) override {
        const std::filesystem::path beside = std::filesystem::path(includer).parent_path() / name;
        for (const std::filesystem::path& path : {beside, std::filesystem::path(name)}) {
            std::ifstream file(root / path, std::ios::binary);
            if (file) {
                auto* const text = new std::string(std::istreambuf_iterator<char>(file), {});
                return new IncludeResult(path.generic_string(), text->data(), text->size(), text);
            }
        }
        return nullptr;
    }

    void releaseInclude(IncludeResult* const result) override {
        if (result != nullptr) {
            delete static_cast<std::string*>(result->userData);
            delete result;
        }
    }

  private:
    const std::filesystem::path& root;
};

// Returns the stub that shaders/CMakeLists.txt writes for each program.
std::string stub(const std::string& kernel, const std::string& traversal, const Memory memory) {
    const std::string include =
        traversal.empty() ? "" : fmt::format("#include \"traversal/{}.glsl\"\n", traversal);
    return fmt::format("#version {}\n"
                       "#extension GL_GOOGLE_include_directive : require\n"
                       "#define METAMARCH_TEXEL_BUFFERS {}\n"
                       "{}#include \"kernels/{}.glsl\"\n",
                       kGlslVersion, memory == Memory::texel ? 1 : 0, include, kernel);
}

} // namespace

ShaderCompiler::ShaderCompiler(std::filesystem::path folder) : root(std::move(folder)) {
    glslang::InitializeProcess();
}

ShaderCompiler::~ShaderCompiler() { glslang::FinalizeProcess(); }

ShaderCompiler::Result ShaderCompiler::compile(const std::string& kernel, const std::string& traversal,
                                               const Memory memory) const {
    const std::string text = stub(kernel, traversal, memory);
    const std::string name = traversal.empty() ? kernel : kernel + "." + traversal;
    const char* const source = text.c_str();
    const auto length = static_cast<int>(text.size());
    const char* const label = name.c_str();
    glslang::TShader shader(EShLangCompute);
    shader.setStringsWithLengthsAndNames(&source, &length, &label, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, kGlslVersion);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    Includer includer(root);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), kGlslVersion, false, rules, includer)) {
        return {{}, shader.getInfoLog()};
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules)) {
        return {{}, program.getInfoLog()};
    }
    Result result;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), result.spirv);
    return result;
}

} // namespace metamarch::viewer
