// SPDX-License-Identifier: MIT
// The SPIR-V that the program holds, judged by the validator of Khronos.
#include "fixtures/optimized_path_tracer.h"
#include "metamarch/shaders/shader_library.h"
#include "metamarch/shared/features.h"
#include "metamarch/shared/shading_layout.h"
#include "metamarch/vulkan/dead_branches.h"
#include "metamarch/vulkan/else_branches.h"
#include "metamarch/vulkan/exact_floats.h"
#include "metamarch/vulkan/initializers.h"
#include "metamarch/vulkan/spirv_instructions.h"
#include "shaders/spirv_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <queue>
#include <set>
#include <span>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>
#include <spirv/unified1/spirv.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {
namespace tests {
namespace {

// Returns what is wrong with a module; empty if it is valid for the Vulkan that the program asks for.
std::string faultsOf(const std::vector<uint32_t>& spirv) {
    std::string faults;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    tools.SetMessageConsumer([&](auto, auto, auto, const char* message) { faults.append(message) += '\n'; });
    if (!tools.Validate(spirv) && faults.empty()) {
        faults = "not valid";
    }
    return faults;
}

TEST(Spirv, isValidInEveryShader) {
    for (const Shader& shader : shaders()) {
        EXPECT_EQ(faultsOf({shader.spirv.begin(), shader.spirv.end()}), "")
            << shader.kernel << ' ' << shader.traversal;
    }
}

TEST(Spirv, isJudgedByAValidatorThatFindsFaults) {
    const std::span<const uint32_t> words = shaders().front().spirv;
    std::vector<uint32_t> cut(words.begin(), words.end());
    cut.pop_back();
    EXPECT_NE(faultsOf(cut), "");
}

TEST(Spirv, ofThePathTracerIsOptimized) {
    for (const Shader& shader : shaders()) {
        if (shader.kernel == "path") {
            EXPECT_EQ(optimizedPathTracer(shader.spirv).size(), shader.spirv.size()) << shader.traversal;
        }
    }
}

// glslang 12's search for what a `precise` reaches may never end: withExactFloats decorates instead.
TEST(Spirv, hasNoPreciseValues) {
    for (const Shader& shader : shaders()) {
        EXPECT_EQ(readLayout(shader.spirv).exactIds.size(), 0u) << shader.kernel << ' ' << shader.traversal;
    }
}

// A driver may contract or reorder what is not decorated, and then its bits differ from the CPU's.
TEST(ExactFloats, leaveNoOperationThatMayBeContracted) {
    for (const Shader& shader : shaders()) {
        const SpirvLayout before = readLayout(shader.spirv);
        const SpirvLayout after = readLayout(vulkan::withExactFloats(shader.spirv, {}));
        EXPECT_EQ(after.looseFloatOperations, 0u) << shader.kernel << ' ' << shader.traversal;
        EXPECT_EQ(after.exactFloatOperations, before.looseFloatOperations);
        EXPECT_EQ(after.exactIds.size(), after.exactFloatOperations) << "more than float operations";
    }
}

class FloatModesOf : public testing::TestWithParam<vulkan::FloatModes> {};

TEST_P(FloatModesOf, leaveAModuleValid) {
    const vulkan::FloatModes& modes = GetParam();
    std::string_view before;
    for (const Shader& shader : shaders()) {
        if (shader.kernel != before) { // one of each kernel
            const std::vector<uint32_t> words = withExactFloats(shader.spirv, modes);
            EXPECT_EQ(faultsOf(words), "") << shader.kernel;
            const std::size_t added =
                std::size_t{6} * (modes.roundsToNearestEven + modes.keepsSignsInfinitiesAndNans) +
                std::size_t{3} * readLayout(shader.spirv).looseFloatOperations;
            EXPECT_EQ(words.size(), shader.spirv.size() + added) << shader.kernel;
            before = shader.kernel;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, FloatModesOf,
                         testing::Values(vulkan::FloatModes{false, false}, vulkan::FloatModes{true, false},
                                         vulkan::FloatModes{false, true}, vulkan::FloatModes{true, true}));

// Some sets of features: none, all, each one alone, and all but each one.
std::vector<std::uint32_t> featureSets() {
    std::vector<std::uint32_t> sets{0u, kAllFeatures};
    for (std::uint32_t feature = 1u; feature < kFirstFreeFeature; feature <<= 1u) {
        sets.insert(sets.end(), {feature, kAllFeatures & ~feature});
    }
    return sets;
}

TEST(DeadBranches, leaveValidModulesForEveryFeature) {
    for (const Shader& shader : shaders()) {
        const bool isDefault = shader.kernel == "path" && shader.traversal == "meta_table";
        for (const std::uint32_t features :
             isDefault ? featureSets() : std::vector<std::uint32_t>{0u, kAllFeatures}) {
            EXPECT_EQ(faultsOf(vulkan::withoutDeadBranches(shader.spirv, {{kSpecFeatures, features}})), "")
                << shader.kernel << ' ' << shader.traversal << ' ' << features;
        }
    }
}

TEST(DeadBranches, leaveOutWhatTheConstantsTurnOff) {
    for (const Shader& shader : shaders()) {
        if (shader.kernel != "path") {
            continue;
        }
        const auto operations = [&](const std::uint32_t features) {
            return readLayout(vulkan::withoutDeadBranches(shader.spirv, {{kSpecFeatures, features}}))
                .looseFloatOperations;
        };
        EXPECT_EQ(operations(kAllFeatures),
                  readLayout(vulkan::withoutDeadBranches(shader.spirv, {})).looseFloatOperations);
        EXPECT_LT(operations(0u), operations(kAllFeatures) * 2 / 3);
        for (const std::uint32_t feature :
             {kFeatureCoat, kFeatureTextures, kFeatureEnvironment, kFeatureLightTree, kFeatureSheen}) {
            EXPECT_LT(operations(kAllFeatures & ~feature), operations(kAllFeatures)) << feature;
        }
    }
}

// Assembles a module whose main has these blocks. %isOn is false where constant 0 is 0, and %isUnknown is not
// decided.
std::vector<uint32_t> moduleOf(const std::string& blocks, const std::string& more = "") {
    const std::string text = R"(
        OpCapability Shader
        OpMemoryModel Logical GLSL450
        OpEntryPoint GLCompute %main "main"
        )" + more + R"(
        OpExecutionMode %main LocalSize 1 1 1
        OpDecorate %on SpecId 0
        %void = OpTypeVoid
        %function = OpTypeFunction %void
        %bool = OpTypeBool
        %uint = OpTypeInt 32 0
        %local = OpTypePointer Function %uint
        %zero = OpConstant %uint 0
        %one = OpConstant %uint 1
        %isUnknown = OpUndef %bool
        %on = OpSpecConstant %uint 1
        %isOn = OpSpecConstantOp %bool INotEqual %on %zero
        %main = OpFunction %void None %function
        )" + blocks + "OpFunctionEnd";
    std::vector<uint32_t> words;
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2);
    if (!tools.Assemble(text, &words)) {
        throw std::runtime_error("the test's module does not assemble");
    }
    return words;
}

std::size_t countOf(const std::vector<uint32_t>& spirv, const spv::Op opcode) {
    return static_cast<std::size_t>(
        std::ranges::count(vulkan::spirvInstructions(spirv), uint32_t{opcode}, vulkan::opcodeOf));
}

// A loop that constant 0 leaves in its first turn. `phis` are those of its header.
std::string loopThatIsLeft(const std::string& phis) {
    return "%entry = OpLabel\n OpBranch %head\n %head = OpLabel\n" + phis + R"(
        OpLoopMerge %after %again None
        OpBranch %body
        %body = OpLabel
        OpSelectionMerge %rest None
        OpBranchConditional %isOn %leave %rest
        %leave = OpLabel
        OpBranch %after
        %rest = OpLabel
        OpBranch %again
        %again = OpLabel
        OpBranch %head
        %after = OpLabel
        OpReturn
    )";
}

TEST(DeadBranches, keepTheContinueBlockOfALoopThatEndsInItsFirstTurn) {
    const std::vector<uint32_t> spirv = moduleOf(loopThatIsLeft(""));
    ASSERT_EQ(faultsOf(spirv), "");
    for (const uint32_t on : {0u, 1u}) {
        const std::vector<uint32_t> words = vulkan::withoutDeadBranches(spirv, {{0u, on}});
        EXPECT_EQ(faultsOf(words), "") << on;
        EXPECT_EQ(countOf(words, spv::OpBranchConditional), 0u);
        EXPECT_EQ(countOf(words, spv::OpLoopMerge), 1u);
        EXPECT_EQ(countOf(words, spv::OpLabel), 6u) << on; // without %rest, or without %leave
    }
}

TEST(DeadBranches, leaveALoopAloneThatKeepsAValueForItsNextTurn) {
    const std::vector<uint32_t> spirv =
        moduleOf(loopThatIsLeft("%turn = OpPhi %uint %zero %entry %one %again\n"));
    ASSERT_EQ(faultsOf(spirv), "");
    const std::vector<uint32_t> words = vulkan::withoutDeadBranches(spirv, {{0u, 1u}});
    EXPECT_EQ(faultsOf(words), "");
    EXPECT_EQ(countOf(words, spv::OpBranchConditional), 1u);
}

TEST(DeadBranches, keepTheEndOfASelectionThatNothingReaches) {
    const std::vector<uint32_t> spirv = moduleOf(R"(
        %entry = OpLabel
        OpSelectionMerge %end None
        OpBranchConditional %isUnknown %left %right
        %left = OpLabel
        OpReturn
        %right = OpLabel
        OpReturn
        %end = OpLabel
        OpReturn
    )");
    ASSERT_EQ(faultsOf(spirv), "");
    const std::vector<uint32_t> words = vulkan::withoutDeadBranches(spirv, {});
    EXPECT_EQ(faultsOf(words), "");
    EXPECT_EQ(countOf(words, spv::OpUnreachable), 1u);
}

TEST(DeadBranches, changeNothingInAModuleOfSeveralEntryPoints) {
    const std::vector<uint32_t> spirv =
        moduleOf(loopThatIsLeft(""), "OpEntryPoint GLCompute %main \"other\"\n");
    EXPECT_EQ(vulkan::withoutDeadBranches(spirv, {{0u, 1u}}), spirv);
}

TEST(DeadBranches, changeNothingInADamagedModule) {
    const std::vector<uint32_t> damaged = {0x07230203u, 0x00010500u, 0, 1, 0, 15};
    EXPECT_EQ(vulkan::withoutDeadBranches(damaged, {}), damaged);
    EXPECT_EQ(vulkan::withoutDeadBranches({}, {}), std::vector<uint32_t>());
}

// The branches of a module whose only function is main.
struct Branches {
    std::map<uint32_t, std::vector<uint32_t>> targets; // by the block's label
    std::map<uint32_t, uint32_t> loops;                // merge blocks, by the header's label

    explicit Branches(const std::vector<uint32_t>& spirv) {
        uint32_t block = 0;
        for (const vulkan::SpirvInstruction instruction : vulkan::spirvInstructions(spirv)) {
            switch (vulkan::opcodeOf(instruction)) {
            case spv::OpLabel:
                block = instruction[1];
                break;
            case spv::OpLoopMerge:
                loops[block] = instruction[1];
                break;
            case spv::OpBranch:
                targets[block] = {instruction[1]};
                break;
            case spv::OpBranchConditional:
                targets[block] = {instruction[2], instruction[3]};
                break;
            case spv::OpSwitch:
                targets[block] = {instruction[2]};
                for (std::size_t i = 4; i < instruction.size(); i += 2) {
                    targets[block].push_back(instruction[i]);
                }
                break;
            default:
                break;
            }
        }
    }
};

// Returns how many blocks SwiftShader visits to learn what a loop's header reaches, at most `most`. It walks
// breadth first and marks a block when it leaves the queue.
std::size_t visitsOfSwiftShader(const Branches& branches, const uint32_t header, const std::size_t most) {
    std::set<uint32_t> seen{branches.loops.at(header)};
    std::queue<uint32_t> pending({header});
    std::size_t visits = 0;
    for (; !pending.empty() && visits < most; ++visits) {
        const uint32_t block = pending.front();
        pending.pop();
        if (const auto found = branches.targets.find(block); found != branches.targets.end()) {
            // The targets of a block are in a set; where it has two, the one that came last is first.
            for (auto target = found->second.rbegin(); target != found->second.rend(); ++target) {
                if (!seen.contains(*target)) {
                    pending.push(*target);
                }
            }
        }
        seen.insert(block);
    }
    return visits;
}

// SwiftShader runs these passes of SPIRV-Tools.
std::vector<uint32_t> optimizedBySwiftShader(const std::vector<uint32_t>& spirv) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPerformancePasses();
    std::vector<uint32_t> optimized;
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);
    if (!optimizer.Run(spirv.data(), spirv.size(), &optimized, options)) {
        throw std::runtime_error("SPIRV-Tools cannot optimize the module");
    }
    return optimized;
}

std::size_t visitsOfSwiftShader(const std::vector<uint32_t>& spirv, const std::size_t most) {
    const std::vector<uint32_t> optimized = optimizedBySwiftShader(spirv);
    const Branches branches(optimized);
    std::size_t visits = 0;
    for (const auto& loop : branches.loops) {
        visits = std::max(visits, visitsOfSwiftShader(branches, loop.first, most));
    }
    return visits;
}

// SPIRV-Tools takes long for the whole path tracer.
std::vector<uint32_t> pathTracerWith(const uint32_t features) {
    const auto shader = std::ranges::find_if(shaders(), [](const Shader& candidate) {
        return candidate.kernel == "path" && candidate.traversal == "meta_table";
    });
    if (shader == shaders().end()) {
        throw std::runtime_error("there is no path tracer with the meta table");
    }
    return vulkan::withoutDeadBranches(shader->spirv, {{kSpecFeatures, features}});
}

TEST(ElseBranches, leaveValidModules) {
    for (const Shader& shader : shaders()) {
        EXPECT_EQ(faultsOf(vulkan::withoutElseBranches(shader.spirv)), "")
            << shader.kernel << ' ' << shader.traversal;
    }
}

TEST(ElseBranches, areWhatSwiftShaderCannotTake) {
    constexpr std::size_t kMost = 1'000'000;
    const std::vector<uint32_t> whole = pathTracerWith(0);
    EXPECT_EQ(visitsOfSwiftShader(whole, kMost), kMost);
    EXPECT_LT(visitsOfSwiftShader(vulkan::withoutElseBranches(whole), kMost), kMost / 4);
}

TEST(ElseBranches, becomeSelectionsOfTheirOwn) {
    const std::vector<uint32_t> spirv = moduleOf(R"(
        %entry = OpLabel
        OpSelectionMerge %end None
        OpBranchConditional %isUnknown %left %right
        %left = OpLabel
        OpBranch %end
        %right = OpLabel
        OpBranch %end
        %end = OpLabel
        OpReturn
    )");
    ASSERT_EQ(faultsOf(spirv), "");
    const std::vector<uint32_t> words = vulkan::withoutElseBranches(spirv);
    EXPECT_EQ(faultsOf(words), "");
    EXPECT_EQ(countOf(words, spv::OpBranchConditional), 2u);
    EXPECT_EQ(countOf(words, spv::OpLabel), 5u);
    EXPECT_EQ(vulkan::withoutElseBranches(words), words) << "there is no else any more";
}

TEST(ElseBranches, stayWhereOneOfThemLeavesTheFunction) {
    const std::vector<uint32_t> spirv = moduleOf(R"(
        %entry = OpLabel
        OpSelectionMerge %end None
        OpBranchConditional %isUnknown %left %right
        %left = OpLabel
        OpReturn
        %right = OpLabel
        OpBranch %end
        %end = OpLabel
        OpReturn
    )");
    ASSERT_EQ(faultsOf(spirv), "");
    EXPECT_EQ(vulkan::withoutElseBranches(spirv), spirv);
}

// The new block would come to the end with a value of neither branch.
TEST(ElseBranches, stayWhereTheEndChoosesAValue) {
    const std::vector<uint32_t> spirv = moduleOf(R"(
        %entry = OpLabel
        OpSelectionMerge %end None
        OpBranchConditional %isUnknown %left %right
        %left = OpLabel
        OpBranch %end
        %right = OpLabel
        OpBranch %end
        %end = OpLabel
        %chosen = OpPhi %uint %zero %left %one %right
        OpReturn
    )");
    ASSERT_EQ(faultsOf(spirv), "");
    EXPECT_EQ(vulkan::withoutElseBranches(spirv), spirv);
}

TEST(ElseBranches, stayInADamagedModule) {
    const std::vector<uint32_t> damaged = {0x07230203u, 0x00010500u, 0, 1, 0, 15};
    EXPECT_EQ(vulkan::withoutElseBranches(damaged), damaged);
    // Instructions with too few words.
    const std::vector<uint32_t> cut = {0x07230203u,
                                       0x00010500u,
                                       0,
                                       1,
                                       0,
                                       vulkan::firstSpirvWord(spv::OpSelectionMerge, 1),
                                       vulkan::firstSpirvWord(spv::OpBranchConditional, 1),
                                       vulkan::firstSpirvWord(spv::OpLabel, 1)};
    EXPECT_EQ(vulkan::withoutElseBranches(cut), cut);
    EXPECT_EQ(vulkan::withoutElseBranches({}), std::vector<uint32_t>());
}

TEST(Initializers, leaveValidModules) {
    for (const Shader& shader : shaders()) {
        EXPECT_EQ(faultsOf(vulkan::withInitializers(shader.spirv)), "")
            << shader.kernel << ' ' << shader.traversal;
    }
}

TEST(Initializers, endTheSearchForValues) {
    const std::vector<uint32_t> kernel = vulkan::withoutElseBranches(pathTracerWith(kFeatureFacets));
    const auto idsOf = [](const std::vector<uint32_t>& spirv) {
        return optimizedBySwiftShader(spirv)[vulkan::kSpirvBound];
    };
    EXPECT_LT(idsOf(vulkan::withInitializers(kernel)), 2 * idsOf(kernel) / 3);
}

// The second variable has one.
TEST(Initializers, areZeroWhereThereIsNone) {
    const std::vector<uint32_t> spirv = moduleOf(R"(
        %entry = OpLabel
        %without = OpVariable %local Function
        %with = OpVariable %local Function %one
        OpReturn
    )");
    ASSERT_EQ(faultsOf(spirv), "");
    const std::vector<uint32_t> words = vulkan::withInitializers(spirv);
    EXPECT_EQ(faultsOf(words), "");
    EXPECT_EQ(countOf(words, spv::OpConstantNull), 1u);
    EXPECT_EQ(words.size(), spirv.size() + 4); // the constant, and a word that names it
    EXPECT_EQ(vulkan::withInitializers(words), words);
}

TEST(Initializers, changeNothingInADamagedModule) {
    const std::vector<uint32_t> damaged = {0x07230203u, 0x00010500u, 0, 1, 0, 15};
    EXPECT_EQ(vulkan::withInitializers(damaged), damaged);
    // Instructions with too few words.
    std::vector<uint32_t> cut = {0x07230203u, 0x00010500u, 0, 1, 0};
    for (const uint32_t opcode : {spv::OpTypeInt, spv::OpTypeVector, spv::OpTypeStruct, spv::OpTypePointer,
                                  spv::OpVariable, spv::OpFunction}) {
        cut.push_back(vulkan::firstSpirvWord(opcode, 1));
    }
    EXPECT_EQ(vulkan::withInitializers(cut), cut);
    EXPECT_EQ(vulkan::withInitializers({}), std::vector<uint32_t>());
}

TEST(ExactFloats, changeNothingInADamagedModule) {
    const std::vector<uint32_t> damaged = {0x07230203u, 0x00010500u, 0,
                                           1,           0,           15}; // an instruction of no words
    EXPECT_EQ(vulkan::withExactFloats(damaged, {true, true}), damaged);
    EXPECT_EQ(vulkan::withExactFloats({}, {true, true}), std::vector<uint32_t>());
}

} // namespace
} // namespace tests
} // namespace metamarch
