// SPDX-License-Identifier: MIT
#include "metamarch/image/comparison.h"

#include "metamarch/image/aov.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace metamarch {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A double holds every value of a channel exactly, whatever its type.
struct Channel {
    std::string name;
    bool isOfIds;
    std::size_t index; // in Image::channels or Image::idChannels

    double at(const Image& image, const std::size_t pixel) const {
        return isOfIds ? static_cast<double>(image.ids[pixel * image.idChannels.size() + index])
                       : static_cast<double>(image.pixels[pixel * image.channels.size() + index]);
    }
};

struct ChannelPair {
    Channel inA;
    Channel inB;
};

std::vector<Channel> channelsOf(const Image& image) {
    std::vector<Channel> all;
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
        all.push_back({image.channels[i], false, i});
    }
    for (std::size_t i = 0; i < image.idChannels.size(); ++i) {
        all.push_back({image.idChannels[i], true, i});
    }
    return all;
}

// Returns a - b, but 0 for equal infinities and for two NaNs; one NaN gives NaN.
double signedDifference(const double a, const double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) {
        return 0.0;
    }
    return a - b;
}

double absoluteDifference(double difference) {
    return std::isnan(difference) ? kInfinity : std::abs(difference);
}

double relativeSquare(const double absolute, const double reference) {
    if (absolute == 0.0 || std::isinf(absolute)) {
        return absolute;
    }
    return absolute * absolute / (reference * reference + kRelativeMseFloor);
}

// Accumulates the sums for the ChannelComparison of one channel.
class ChannelSums {
  public:
    // Adds a pixel and returns its absolute difference.
    double add(const double a, const double b, const std::size_t pixel) {
        const double difference = signedDifference(a, b);
        const double absolute = absoluteDifference(difference);
        sum_ += difference;
        squares_ += absolute * absolute;
        relativeSquares_ += relativeSquare(absolute, b);
        if (absolute > worst_) {
            worst_ = absolute;
            worstPixel_ = pixel;
        }
        return absolute;
    }

    void finish(ChannelComparison& channel, const Image& a, const Image& b, const ChannelPair& pair) const {
        const double count = static_cast<double>(a.pixelCount());
        channel.rmse = std::sqrt(squares_ / count);
        channel.relativeMse = relativeSquares_ / count;
        channel.meanDifference = sum_ / count;
        channel.maxDifference = worst_;
        const std::size_t width = static_cast<std::size_t>(a.width);
        channel.worstX = static_cast<int>(worstPixel_ % width);
        channel.worstY = static_cast<int>(worstPixel_ / width);
        channel.worstA = pair.inA.at(a, worstPixel_);
        channel.worstB = pair.inB.at(b, worstPixel_);
    }

  private:
    double sum_ = 0.0;
    double squares_ = 0.0;
    double relativeSquares_ = 0.0;
    double worst_ = 0.0;
    std::size_t worstPixel_ = 0;
};

std::vector<ChannelPair> commonChannels(const Image& a, const Image& b) {
    std::vector<ChannelPair> pairs;
    const std::vector<Channel> ofB = channelsOf(b);
    for (const Channel& inA : channelsOf(a)) {
        const auto inB = std::ranges::find(ofB, inA.name, &Channel::name);
        if (inB != ofB.end()) {
            pairs.push_back({inA, *inB});
        }
    }
    return pairs;
}

bool hasChannel(const Image& image, const std::string_view name) {
    return image.findChannel(name) || image.findIdChannel(name);
}

void addMissingChannels(const Image& from, const Image& in, const char* which, Comparison& comparison) {
    for (const Channel& channel : channelsOf(from)) {
        if (isJudged(channel.name) && !hasChannel(in, channel.name)) {
            comparison.mismatches.push_back("channel " + channel.name + " is only in the " + which +
                                            " picture");
        }
    }
}

std::string sizeOf(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

void compareChannels(const Image& a, const Image& b, double maxAbs, Comparison& comparison) {
    const std::size_t pixels = a.pixelCount();
    const std::vector<ChannelPair> pairs = commonChannels(a, b);
    std::vector<bool> failing(pixels, false);
    for (const ChannelPair& pair : pairs) {
        ChannelComparison& channel = comparison.channels.emplace_back();
        channel.name = pair.inA.name;
        channel.isOfIds = pair.inA.isOfIds && pair.inB.isOfIds;
        channel.judged = isJudged(channel.name);
        if (pair.inA.isOfIds != pair.inB.isOfIds) {
            comparison.mismatches.push_back("channel " + channel.name + " has whole numbers only in the " +
                                            (pair.inA.isOfIds ? "first" : "second") + " picture");
        }
        ChannelSums sums;
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            if (sums.add(pair.inA.at(a, pixel), pair.inB.at(b, pixel), pixel) > maxAbs) {
                ++channel.failingPixels;
                comparison.failingPixels += channel.judged && !failing[pixel];
                failing[pixel] = failing[pixel] || channel.judged;
            }
        }
        sums.finish(channel, a, b, pair);
        channel.failingPercent =
            100.0 * static_cast<double>(channel.failingPixels) / static_cast<double>(pixels);
    }
}

} // namespace

bool isJudged(const std::string_view channel) {
    return std::ranges::none_of(aovs(), [&](const Aov& aov) {
        const std::vector<std::string> channels = aov.channels();
        return aov.kind == AovKind::work && std::ranges::find(channels, channel) != channels.end();
    });
}

Comparison compareImages(const Image& a, const Image& b, const ComparisonBounds& bounds) {
    Comparison comparison;
    addMissingChannels(a, b, "first", comparison);
    addMissingChannels(b, a, "second", comparison);
    if (a.width != b.width || a.height != b.height) {
        comparison.mismatches.push_back("the sizes are " + sizeOf(a) + " and " + sizeOf(b));
        return comparison;
    }

    comparison.pixels = a.pixelCount();
    compareChannels(a, b, bounds.maxAbs, comparison);
    bool anyJudged = false;
    for (const ChannelComparison& channel : comparison.channels) {
        anyJudged = anyJudged || channel.judged;
    }
    if (!anyJudged) {
        comparison.mismatches.emplace_back("they have no channel in common that is judged");
    }
    comparison.failingPercent =
        100.0 * static_cast<double>(comparison.failingPixels) / static_cast<double>(comparison.pixels);
    comparison.passed = comparison.mismatches.empty() && comparison.failingPercent <= bounds.maxFailPercent;
    return comparison;
}

Image differenceImage(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) {
        throw std::invalid_argument("differenceImage: the sizes differ");
    }
    const std::vector<ChannelPair> pairs = commonChannels(a, b);
    std::vector<std::string> names;
    names.reserve(pairs.size());
    for (const ChannelPair& pair : pairs) {
        names.push_back(pair.inA.name);
    }

    Image picture(a.width, a.height, names);
    std::size_t next = 0;
    for (std::size_t pixel = 0; pixel < a.pixelCount(); ++pixel) {
        for (const ChannelPair& pair : pairs) {
            const double difference = signedDifference(pair.inA.at(a, pixel), pair.inB.at(b, pixel));
            picture.pixels[next++] = static_cast<float>(absoluteDifference(difference));
        }
    }
    return picture;
}

} // namespace metamarch
