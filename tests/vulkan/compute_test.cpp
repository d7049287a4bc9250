// SPDX-License-Identifier: MIT
// A kernel runs with its bindings, push constants and specialization constants, and its results come back.
#include "affine_kernel.h"
#include "fixtures/vulkan_environment.h"
#include "metamarch/vulkan/submission.h"
#include "metamarch/vulkan/transfer.h"

#include <gtest/gtest.h>
#include <vulkan/vulkan.hpp>

#include <cstring>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace metamarch::vulkan {
namespace {

std::vector<uint32_t> countUp(uint32_t count) {
    std::vector<uint32_t> values(count);
    std::iota(values.begin(), values.end(), 0u);
    return values;
}

std::vector<uint32_t> affine(std::vector<uint32_t> values, uint32_t factor, uint32_t offset) {
    for (uint32_t& value : values) {
        value = factor * value + offset;
    }
    return values;
}

class ComputeTest : public testing::Test {
  protected:
    static constexpr uint32_t kCount = 1000; // not a multiple of the workgroup size
    static constexpr GroupCount kGroups = {(kCount + 63) / 64, 1, 1};

    const Device& device = testDevice();
    const std::vector<uint32_t> values = countUp(kCount);
    const Buffer inputs = upload(device, std::span(values), "inputs");
    const Buffer outputs = Buffer(device, BufferUse::storage, kCount * sizeof(uint32_t), "outputs");
};

TEST_F(ComputeTest, dispatchComputesTheExactResult) {
    ComputePipeline pipeline = affineKernel(device, 3);
    pipeline.bind(kAffineInputs, inputs);
    pipeline.bind(kAffineOutputs, outputs);
    Submission submission(device);
    const double seconds = submission.run([&](Commands& commands) {
        commands.dispatch(pipeline, kGroups, AffinePush{11, kCount});
    });

    EXPECT_EQ(download<uint32_t>(device, outputs), affine(countUp(kCount), 3, 11));
    EXPECT_GT(seconds, 0.0);
    EXPECT_LT(seconds, 60.0);
}

TEST_F(ComputeTest, defaultOfASpecializationConstantHolds) {
    KernelInfo info = affineInfo();
    info.specialization.clear();
    ComputePipeline pipeline(device, info);
    pipeline.bind(kAffineInputs, inputs);
    pipeline.bind(kAffineOutputs, outputs);
    Submission(device).run([&](Commands& commands) {
        commands.dispatch(pipeline, kGroups, AffinePush{0, kCount});
    });

    EXPECT_EQ(download<uint32_t>(device, outputs), countUp(kCount));
}

TEST_F(ComputeTest, pipelinesOfTheSameKernelShareIt) {
    const ComputePipeline first = affineKernel(device, 21);
    const ComputePipeline same = affineKernel(device, 21);
    const ComputePipeline other = affineKernel(device, 22);
    EXPECT_EQ(first.handle(), same.handle());
    EXPECT_NE(first.descriptorSet(), same.descriptorSet());
    EXPECT_NE(first.handle(), other.handle());
}

// More kernels than are kept. The pipelines of those that are dropped go on.
TEST_F(ComputeTest, manyKernels) {
    ComputePipeline oldest = affineKernel(device, 100);
    oldest.bind(kAffineInputs, inputs);
    oldest.bind(kAffineOutputs, outputs);
    for (uint32_t factor = 101; factor < 150; ++factor) {
        const ComputePipeline newer = affineKernel(device, factor);
    }
    Submission(device).run([&](Commands& commands) {
        commands.dispatch(oldest, kGroups, AffinePush{1, kCount});
    });
    EXPECT_EQ(download<uint32_t>(device, outputs), affine(countUp(kCount), 100, 1));
}

TEST_F(ComputeTest, commandsSeeWhatEarlierOnesWrote) {
    const Buffer between(device, BufferUse::storage, outputs.size(), "between");
    ComputePipeline first = affineKernel(device, 2);
    first.bind(kAffineInputs, inputs);
    first.bind(kAffineOutputs, between);
    ComputePipeline second = affineKernel(device, 5);
    second.bind(kAffineInputs, between);
    second.bind(kAffineOutputs, outputs);
    const Buffer readback(device, BufferUse::readback, outputs.size(), "readback");

    Submission submission(device);
    submission.run([&](Commands& commands) {
        commands.fill(outputs, 0xffffffffu); // the second dispatch overwrites it
        commands.dispatch(first, kGroups, AffinePush{1, kCount});
        commands.dispatch(second, kGroups, AffinePush{7, kCount});
        commands.copy(outputs, 0, readback, 0, readback.size());
    });

    std::vector<uint32_t> read(kCount);
    std::memcpy(read.data(), readback.mapped().data(), readback.size());
    EXPECT_EQ(read, affine(affine(countUp(kCount), 2, 1), 5, 7));
}

TEST_F(ComputeTest, submissionIsReused) {
    ComputePipeline pipeline = affineKernel(device, 1);
    pipeline.bind(kAffineInputs, inputs);
    pipeline.bind(kAffineOutputs, outputs);
    Submission submission(device);
    for (uint32_t round = 0; round < 20; ++round) {
        submission.run([&](Commands& commands) {
            commands.dispatch(pipeline, kGroups, AffinePush{round, kCount});
        });
    }
    EXPECT_EQ(download<uint32_t>(device, outputs), affine(countUp(kCount), 1, 19));
}

TEST_F(ComputeTest, twoSubmissionsAreInFlightTogether) {
    ComputePipeline first = affineKernel(device, 2);
    first.bind(kAffineInputs, inputs);
    first.bind(kAffineOutputs, outputs);
    const Buffer last(device, BufferUse::storage, outputs.size(), "last");
    ComputePipeline second = affineKernel(device, 3);
    second.bind(kAffineInputs, outputs);
    second.bind(kAffineOutputs, last);

    Submission one(device);
    Submission two(device);
    one.start([&](Commands& commands) { commands.dispatch(first, kGroups, AffinePush{0, kCount}); });
    two.start([&](Commands& commands) { commands.dispatch(second, kGroups, AffinePush{0, kCount}); });
    two.wait();
    one.wait();
    EXPECT_EQ(download<uint32_t>(device, last), affine(countUp(kCount), 6, 0));
}

TEST_F(ComputeTest, destructorWaitsForWorkInFlight) {
    ComputePipeline pipeline = affineKernel(device, 4);
    pipeline.bind(kAffineInputs, inputs);
    pipeline.bind(kAffineOutputs, outputs);
    {
        Submission submission(device);
        submission.start([&](Commands& commands) {
            commands.dispatch(pipeline, kGroups, AffinePush{0, kCount});
        });
    }
    EXPECT_EQ(download<uint32_t>(device, outputs), affine(countUp(kCount), 4, 0));
}

TEST_F(ComputeTest, submissionIsUsableAfterItsRecorderThrew) {
    Submission submission(device);
    EXPECT_THROW(submission.run([](Commands&) { throw std::runtime_error("stop"); }), std::runtime_error);
    submission.run([&](Commands& commands) { commands.fill(outputs, 5); });
    EXPECT_EQ(download<uint32_t>(device, outputs), std::vector<uint32_t>(kCount, 5u));
}

TEST_F(ComputeTest, wrongUseIsRefused) {
    const ComputePipeline pipeline = affineKernel(device, 1);
    Submission submission(device);
    EXPECT_THROW(submission.run([&](Commands& commands) { commands.dispatch(pipeline, kGroups); }),
                 std::logic_error);
    EXPECT_THROW(submission.wait(), std::logic_error);
}

} // namespace
} // namespace metamarch::vulkan
