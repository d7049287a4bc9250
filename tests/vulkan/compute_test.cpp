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

    const Device& device_ = testDevice();
    const std::vector<uint32_t> values_ = countUp(kCount);
    const Buffer inputs_ = upload(device_, std::span(values_), "inputs");
    const Buffer outputs_ = Buffer(device_, BufferUse::storage, kCount * sizeof(uint32_t), "outputs");
};

TEST_F(ComputeTest, dispatchComputesTheExactResult) {
    ComputePipeline pipeline = affineKernel(device_, 3);
    pipeline.bind(kAffineInputs, inputs_);
    pipeline.bind(kAffineOutputs, outputs_);
    Submission submission(device_);
    const double seconds = submission.run([&](Commands& commands) {
        commands.dispatch(pipeline, kGroups, AffinePush{11, kCount});
    });

    EXPECT_EQ(download<uint32_t>(device_, outputs_), affine(countUp(kCount), 3, 11));
    EXPECT_GT(seconds, 0.0);
    EXPECT_LT(seconds, 60.0);
}

TEST_F(ComputeTest, defaultOfASpecializationConstantHolds) {
    KernelInfo info = affineInfo();
    info.specialization.clear();
    ComputePipeline pipeline(device_, info);
    pipeline.bind(kAffineInputs, inputs_);
    pipeline.bind(kAffineOutputs, outputs_);
    Submission(device_).run([&](Commands& commands) {
        commands.dispatch(pipeline, kGroups, AffinePush{0, kCount});
    });

    EXPECT_EQ(download<uint32_t>(device_, outputs_), countUp(kCount));
}

TEST_F(ComputeTest, pipelinesOfTheSameKernelShareIt) {
    const ComputePipeline first = affineKernel(device_, 21);
    const ComputePipeline same = affineKernel(device_, 21);
    const ComputePipeline other = affineKernel(device_, 22);
    EXPECT_EQ(first.handle(), same.handle());
    EXPECT_NE(first.descriptorSet(), same.descriptorSet());
    EXPECT_NE(first.handle(), other.handle());
}

// More kernels than are kept. The pipelines of those that are dropped go on.
TEST_F(ComputeTest, manyKernels) {
    ComputePipeline oldest = affineKernel(device_, 100);
    oldest.bind(kAffineInputs, inputs_);
    oldest.bind(kAffineOutputs, outputs_);
    for (uint32_t factor = 101; factor < 150; ++factor) {
        const ComputePipeline newer = affineKernel(device_, factor);
    }
    Submission(device_).run([&](Commands& commands) {
        commands.dispatch(oldest, kGroups, AffinePush{1, kCount});
    });
    EXPECT_EQ(download<uint32_t>(device_, outputs_), affine(countUp(kCount), 100, 1));
}

TEST_F(ComputeTest, commandsSeeWhatEarlierOnesWrote) {
    const Buffer between(device_, BufferUse::storage, outputs_.size(), "between");
    ComputePipeline first = affineKernel(device_, 2);
    first.bind(kAffineInputs, inputs_);
    first.bind(kAffineOutputs, between);
    ComputePipeline second = affineKernel(device_, 5);
    second.bind(kAffineInputs, between);
    second.bind(kAffineOutputs, outputs_);
    const Buffer readback(device_, BufferUse::readback, outputs_.size(), "readback");

    Submission submission(device_);
    submission.run([&](Commands& commands) {
        commands.fill(outputs_, 0xffffffffu); // the second dispatch overwrites it
        commands.dispatch(first, kGroups, AffinePush{1, kCount});
        commands.dispatch(second, kGroups, AffinePush{7, kCount});
        commands.copy(outputs_, 0, readback, 0, readback.size());
    });

    std::vector<uint32_t> values(kCount);
    std::memcpy(values.data(), readback.mapped().data(), readback.size());
    EXPECT_EQ(values, affine(affine(countUp(kCount), 2, 1), 5, 7));
}

TEST_F(ComputeTest, submissionIsReused) {
    ComputePipeline pipeline = affineKernel(device_, 1);
    pipeline.bind(kAffineInputs, inputs_);
    pipeline.bind(kAffineOutputs, outputs_);
    Submission submission(device_);
    for (uint32_t round = 0; round < 20; ++round) {
        submission.run([&](Commands& commands) {
            commands.dispatch(pipeline, kGroups, AffinePush{round, kCount});
        });
    }
    EXPECT_EQ(download<uint32_t>(device_, outputs_), affine(countUp(kCount), 1, 19));
}

TEST_F(ComputeTest, twoSubmissionsAreInFlightTogether) {
    ComputePipeline first = affineKernel(device_, 2);
    first.bind(kAffineInputs, inputs_);
    first.bind(kAffineOutputs, outputs_);
    const Buffer last(device_, BufferUse::storage, outputs_.size(), "last");
    ComputePipeline second = affineKernel(device_, 3);
    second.bind(kAffineInputs, outputs_);
    second.bind(kAffineOutputs, last);

    Submission one(device_);
    Submission two(device_);
    one.start([&](Commands& commands) { commands.dispatch(first, kGroups, AffinePush{0, kCount}); });
    two.start([&](Commands& commands) { commands.dispatch(second, kGroups, AffinePush{0, kCount}); });
    two.wait();
    one.wait();
    EXPECT_EQ(download<uint32_t>(device_, last), affine(countUp(kCount), 6, 0));
}

TEST_F(ComputeTest, destructorWaitsForWorkInFlight) {
    ComputePipeline pipeline = affineKernel(device_, 4);
    pipeline.bind(kAffineInputs, inputs_);
    pipeline.bind(kAffineOutputs, outputs_);
    {
        Submission submission(device_);
        submission.start([&](Commands& commands) {
            commands.dispatch(pipeline, kGroups, AffinePush{0, kCount});
        });
    }
    EXPECT_EQ(download<uint32_t>(device_, outputs_), affine(countUp(kCount), 4, 0));
}

TEST_F(ComputeTest, submissionIsUsableAfterItsRecorderThrew) {
    Submission submission(device_);
    EXPECT_THROW(submission.run([](Commands&) { throw std::runtime_error("stop"); }), std::runtime_error);
    submission.run([&](Commands& commands) { commands.fill(outputs_, 5); });
    EXPECT_EQ(download<uint32_t>(device_, outputs_), std::vector<uint32_t>(kCount, 5u));
}

TEST_F(ComputeTest, wrongUseIsRefused) {
    const ComputePipeline pipeline = affineKernel(device_, 1);
    Submission submission(device_);
    EXPECT_THROW(submission.run([&](Commands& commands) { commands.dispatch(pipeline, kGroups); }),
                 std::logic_error);
    EXPECT_THROW(submission.wait(), std::logic_error);
}

} // namespace
} // namespace metamarch::vulkan
