// SPDX-License-Identifier: MIT
#include "metamarch/cli/render_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace metamarch::cli {
namespace {

struct Rates {
    explicit Rates(const render::RenderResult& result) {
        const render::RenderCounts& counts = result.counts;
        const double rays = counts.rays + counts.shadowRays;
        stepsPerRay = rays > 0.0 ? counts.steps / rays : 0.0;
        testsPerRay = rays > 0.0 ? counts.tests / rays : 0.0;
        // The counts are of all samples of the film, the time is of those that this render took.
        const double part = counts.samples > 0.0 ? result.samplesTaken / counts.samples : 0.0;
        mraysPerSecond = part * rays / result.seconds.render * 1e-6;
        msamplesPerSecond = result.samplesTaken / result.seconds.render * 1e-6;
    }

    double stepsPerRay;
    double testsPerRay;
    double mraysPerSecond;
    double msamplesPerSecond;
};

double meanSamples(const render::RenderResult& result) {
    return result.counts.samples / static_cast<double>(result.area.pixelCount());
}

} // namespace

nlohmann::ordered_json reportRender(const render::RenderResult& result) {
    const Rates rates(result);
    const bool isOnDevice = result.submissions > 0;
    nlohmann::ordered_json report;
    report["device"] = result.device;
    report["driver"] = result.driver;
    report["traversal"] = result.traversal;
    report["integrator"] = nameOf(result.settings.path.integrator);
    report["size"] = {result.size.x, result.size.y};
    if (isOnDevice) {
        report["seconds"]["upload"] = result.seconds.upload;
        report["seconds"]["firstSubmission"] = result.seconds.firstSubmission;
        report["seconds"]["device"] = result.seconds.device;
    }
    report["seconds"]["render"] = result.seconds.render;
    if (result.settings.isPrimary()) {
        report["rays"] = static_cast<std::uint64_t>(result.counts.rays);
        report["hits"] = result.counts.hits;
    } else {
        if (isOnDevice) {
            report["submissions"] = result.submissions;
        }
        report["samplesPerPixel"] = result.settings.samplesPerPixel;
        report["meanSamplesPerPixel"] = meanSamples(result);
        report["rejectedSamples"] = result.counts.rejected;
        report["rays"] = result.counts.rays;
        report["shadowRays"] = result.counts.shadowRays;
        report["msamplesPerSecond"] = rates.msamplesPerSecond;
    }
    report["stepsPerRay"] = rates.stepsPerRay;
    report["testsPerRay"] = rates.testsPerRay;
    report["mraysPerSecond"] = rates.mraysPerSecond;
    return report;
}

std::string summaryOf(const render::RenderResult& result) {
    const Rates rates(result);
    return result.settings.isPrimary()
               ? fmt::format("{:.2f} steps and {:.2f} tests per ray", rates.stepsPerRay, rates.testsPerRay)
               : fmt::format("{:.4g} samples a pixel, {:.2f} Msamples/s, {:.2f} Mrays/s", meanSamples(result),
                             rates.msamplesPerSecond, rates.mraysPerSecond);
}

} // namespace metamarch::cli
