// SPDX-License-Identifier: MIT
#include "metamarch/cli/commands.h"
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/threads.h"
#include "metamarch/error/error.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/image/comparison.h"
#include "metamarch/image/image_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace metamarch::cli {
namespace {

struct CompareOptions {
    std::string pathA;
    std::string pathB;
    ComparisonBounds bounds;
    std::string differencePath;
    std::optional<std::uint32_t> threads;
    bool json = false;
};

void printTable(const Comparison& comparison) {
    if (!comparison.channels.empty()) {
        printResult(fmt::format("{:<12} {:>12} {:>12} {:>13} {:>12} {:>13} {:>14} {:>14} {:>10} {:>9}\n",
                                "channel", "RMSE", "relative MSE", "mean A - B", "max |A - B|", "at x,y",
                                "A there", "B there", "failing", "%"));
    }
    for (const ChannelComparison& channel : comparison.channels) {
        const int digits = channel.isOfIds ? 10 : 8; // a whole number has up to ten
        printResult(fmt::format(
            "{:<12} {:>12.6g} {:>12.6g} {:>13.6g} {:>12.6g} {:>13} {:>14.{}g} {:>14.{}g} {:>10} {:>9.4f}{}\n",
            channel.name, channel.rmse, channel.relativeMse, channel.meanDifference, channel.maxDifference,
            fmt::format("{},{}", channel.worstX, channel.worstY), channel.worstA, digits, channel.worstB,
            digits, channel.failingPixels, channel.failingPercent, channel.judged ? "" : "  (not judged)"));
    }
    for (const std::string& mismatch : comparison.mismatches) {
        printResult(fmt::format("{}\n", mismatch));
    }
    printResult(fmt::format("{}: {} of {} pixels fail ({:.4f} %)\n",
                            comparison.passed ? "within bounds" : "out of bounds", comparison.failingPixels,
                            comparison.pixels, comparison.failingPercent));
}

// JSON has no infinities and no NaN: they become the strings "inf", "-inf" and "nan".
nlohmann::ordered_json jsonNumber(double value) {
    if (std::isfinite(value)) {
        return value;
    }
    return fmt::format("{}", value);
}

nlohmann::ordered_json toJson(const ChannelComparison& channel) {
    return {{"name", channel.name},
            {"judged", channel.judged},
            {"rmse", jsonNumber(channel.rmse)},
            {"relativeMse", jsonNumber(channel.relativeMse)},
            {"meanDifference", jsonNumber(channel.meanDifference)},
            {"maxDifference", jsonNumber(channel.maxDifference)},
            {"worst",
             {{"x", channel.worstX},
              {"y", channel.worstY},
              {"a", jsonNumber(channel.worstA)},
              {"b", jsonNumber(channel.worstB)}}},
            {"failingPixels", channel.failingPixels},
            {"failingPercent", channel.failingPercent}};
}

void printJson(const Comparison& comparison, const CompareOptions& options) {
    nlohmann::ordered_json channels = nlohmann::ordered_json::array();
    for (const ChannelComparison& channel : comparison.channels) {
        channels.push_back(toJson(channel));
    }
    const nlohmann::ordered_json report = {
        {"a", options.pathA},
        {"b", options.pathB},
        {"maxAbs", jsonNumber(options.bounds.maxAbs)},
        {"maxFailPercent", jsonNumber(options.bounds.maxFailPercent)},
        {"passed", comparison.passed},
        {"mismatches", comparison.mismatches},
        {"pixels", comparison.pixels},
        {"failingPixels", comparison.failingPixels},
        {"failingPercent", comparison.failingPercent},
        {"channels", channels},
    };
    // A path may hold bytes that are no UTF-8. They are replaced.
    printResult(
        fmt::format("{}\n", report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

std::string failureLine(const Comparison& comparison, const CompareOptions& options) {
    const std::string pictures = options.pathA + " and " + options.pathB + " differ: ";
    if (!comparison.mismatches.empty()) {
        return pictures + comparison.mismatches.front();
    }
    return pictures +
           fmt::format("{} of {} pixels ({:.4g} %) by more than {}; --max-abs and --max-fail-percent "
                       "set what is allowed, --out shows where",
                       comparison.failingPixels, comparison.pixels, comparison.failingPercent,
                       options.bounds.maxAbs);
}

void runCompare(const CompareOptions& options) {
    if (!options.differencePath.empty()) {
        checkWritable(options.differencePath);
        const NamedFile output[] = {{"--out", options.differencePath}};
        const NamedFile inputs[] = {{"A", options.pathA}, {"B", options.pathB}};
        checkOutputsDiffer(output, inputs);
    }

    const Threads threads(options.threads);
    const Image a = readImage(options.pathA);
    const Image b = readImage(options.pathB);
    const Comparison comparison = compareImages(a, b, options.bounds);
    if (options.json) {
        printJson(comparison, options);
    } else {
        printTable(comparison);
    }
    // Pictures of different sizes, or without a common channel, have no difference picture.
    if (!options.differencePath.empty() && !comparison.channels.empty()) {
        writeImage(differenceImage(a, b), options.differencePath);
    }
    if (!comparison.passed) {
        throw Error(ErrorKind::mismatch, failureLine(comparison, options));
    }
}

} // namespace

Command makeCompareCommand() {
    const auto options = std::make_shared<CompareOptions>();
    const NumberRange bound = {0.0, std::numeric_limits<double>::infinity(), "a bound of 0 or more"};
    Command command{"compare", "Compare two pictures, channel by channel", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positional("A", options->pathA, "Picture to judge");
    settings.positional("B", options->pathB, "Reference");
    settings
        .number("max-abs", options->bounds.maxAbs, bound,
                "A pixel fails when one of its channels differs by more")
        .withValueName("D");
    settings
        .number("max-fail-percent", options->bounds.maxFailPercent, bound,
                "Per cent of the pixels that may fail")
        .withValueName("P");
    settings.text("out", options->differencePath, "Write |A - B| of every common channel to this .exr")
        .withValueName("FILE.exr");
    settings.flag("json", options->json, "Print the report as JSON; \"inf\" and \"nan\" are strings there");
    declareThreads(settings, options->threads);
    command.footer =
        "Per channel: root mean square error; mean of (A-B)^2 / (B^2 + 0.01); mean of A-B; the largest\n"
        "|A-B| and its pixel, counted from the top left; the pixels that fail. One infinity or NaN against\n"
        "another value is an infinite difference. Channels are matched by name; one that only one picture\n"
        "has fails the comparison. The channels `steps` and `tests` count work: reported, never judged.\n"
        "Exit code: 0 within bounds, 1 not.\n\n"
        "Example:\n"
        "  build/metamarch compare build/demo/objects.exr build/demo/objects.exr --max-abs 0";
    command.run = [options](const SettingList&) { runCompare(*options); };
    return command;
}

} // namespace metamarch::cli
