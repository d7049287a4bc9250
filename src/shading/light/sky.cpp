// SPDX-License-Identifier: MIT
#include "metamarch/shading/light/sky.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace metamarch {
namespace {

using glm::dvec3;

// Lengths are in kilometres, coefficients in 1 / kilometre.
constexpr double kGroundRadius = 6360.0;
constexpr double kTopRadius = 6460.0;
constexpr double kAtmosphereHeight = kTopRadius - kGroundRadius;
constexpr double kEyeHeight = 0.002;
const dvec3 kRayleigh(5.802e-3, 13.558e-3, 33.1e-3); // scattering at ground level
constexpr double kRayleighHeight = 8.0;
constexpr double kMieScattering = 3.996e-3;
constexpr double kMieExtinction = 8.396e-3;
constexpr double kMieHeight = 1.2;
constexpr double kMieAsymmetry = 0.8;
const dvec3 kOzone(0.650e-3, 1.881e-3, 0.085e-3); // absorption at its densest height
constexpr double kOzoneCentre = 25.0;
constexpr double kOzoneHalfWidth = 15.0;

constexpr double kSunRadius = 0.2665 * M_PI / 180.0;
constexpr double kSunIrradiance = M_PI; // outside the atmosphere, per colour
constexpr int kSteps = 48;              // number of steps along a line of sight
constexpr int kTableSteps = 256;        // number of steps along a ray to the sun
// Lines of sight divide half a circle into so many parts. Below the horizon the sun leaves an edge of shadow
// in the air, so there are as many lines as columns.
constexpr int kAzimuths = 32;

struct Medium {
    double rayleigh; // density relative to the ground's
    double mie;      // density relative to the ground's, times haze
    dvec3 extinction;
};

// Where a height lies between the rows of the table of transmittances.
struct TableRow {
    int index;
    double part; // of the way to the next row
    double horizon;
};

class Atmosphere {
  public:
    // transmittance() is asked for cosines of [least, most] alone.
    Atmosphere(double haze, double leastCosine, double mostCosine);

    Medium mediumAt(double height) const;

    TableRow rowOf(double height) const;
    // Returns the transmittance from a height above the ground to space, for this cosine to the vertical; 0
    // if the ground is in the way.
    dvec3 transmittance(const TableRow& row, double cosine) const;

  private:
    static constexpr int kHeights = 64;
    static constexpr int kAngles = 256;

    static double columnOf(double horizon, double cosine);
    dvec3 marchedTransmittance(double height, double cosine) const;

    double haze_;
    // Indexed by [height][angle]; both are denser where the value changes faster.
    std::vector<dvec3> transmittances_;
};

// What reaches the eye along a line of sight, but for the phase functions.
struct Scattered {
    dvec3 rayleigh{0.0};
    dvec3 mie{0.0};
};

// All lines of sight of one elevation. What does not depend on their azimuth is worked out once.
class SightLines {
  public:
    // The eye is at kEyeHeight above the ground; `polar` is the angle to the vertical.
    SightLines(const Atmosphere& atmosphere, double polar, const dvec3& sun);

    // Returns the light along the line with this cosine to the sun.
    Scattered scattered(double sunCosine) const;

  private:
    struct Step {
        double distance; // from the eye to the middle of the step
        double radius;   // there, from the earth's centre
        TableRow row;
        dvec3 rayleigh; // part of the sunlight there that reaches the eye, but for the phase function
        dvec3 mie;
    };

    const Atmosphere& atmosphere_;
    double eyeToSun_; // length, along the direction to the sun
    std::vector<Step> steps_;
};

// How the light at an azimuth follows from that of the lines of sight, by the cubic polynomial through the
// four next to it.
struct BetweenLines {
    std::array<int, 4> line;
    std::array<double, 4> weight;
    double cosine; // of the azimuth from the sun
};

// Returns the cosine, relative to the vertical, of the horizon seen from a height; it is negative.
double horizonCosine(double height) {
    const double ratio = kGroundRadius / (kGroundRadius + height);
    return -std::sqrt(1.0 - ratio * ratio);
}

// Returns the first positive distance at which the ray crosses the sphere around the origin.
std::optional<double> distanceToSphere(const dvec3& position, const dvec3& direction, double radius) {
    const double b = glm::dot(position, direction);
    const double discriminant = b * b - glm::dot(position, position) + radius * radius;
    if (discriminant < 0.0) {
        return std::nullopt;
    }
    const double root = std::sqrt(discriminant);
    const double distance = -b - root > 0.0 ? -b - root : -b + root;
    return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

Medium Atmosphere::mediumAt(double height) const {
    const double rayleigh = std::exp(-height / kRayleighHeight);
    const double mie = haze_ * std::exp(-height / kMieHeight);
    const double ozone = std::max(1.0 - std::abs(height - kOzoneCentre) / kOzoneHalfWidth, 0.0);
    return {rayleigh, mie, kRayleigh * rayleigh + dvec3(kMieExtinction * mie) + kOzone * ozone};
}

double heightOf(const dvec3& position) { return std::max(glm::length(position) - kGroundRadius, 0.0); }

dvec3 Atmosphere::marchedTransmittance(double height, double cosine) const {
    const dvec3 position(0.0, kGroundRadius + height, 0.0);
    const dvec3 direction(std::sqrt(1.0 - cosine * cosine), cosine, 0.0);
    const double step = distanceToSphere(position, direction, kTopRadius).value_or(0.0) / kTableSteps;
    dvec3 depth(0.0);
    for (int i = 0; i < kTableSteps; ++i) {
        depth += mediumAt(heightOf(position + direction * (step * (i + 0.5)))).extinction * step;
    }
    return glm::exp(-depth);
}

double Atmosphere::columnOf(const double horizon, const double cosine) {
    return std::sqrt(std::max(cosine - horizon, 0.0) / (1.0 - horizon)) * (kAngles - 1);
}

// Only the columns that are asked for are computed: the sun is seen from all of the visible air at nearly the
// same angle.
Atmosphere::Atmosphere(const double haze, const double leastCosine, const double mostCosine)
    : haze_(haze), transmittances_(std::size_t{kHeights} * kAngles) {
    tbb::parallel_for(0, kHeights, [&](int row) {
        const double height = kAtmosphereHeight * std::pow(row / (kHeights - 1.0), 2.0);
        const double horizon = horizonCosine(height);
        // A height between two rows has a horizon between theirs, so another column next to these may be
        // read.
        constexpr int kBeside = 8;
        const int first = std::max(static_cast<int>(columnOf(horizon, leastCosine)) - kBeside, 0);
        const int last = std::min(static_cast<int>(columnOf(horizon, mostCosine)) + kBeside, kAngles - 1);
        for (int column = first; column <= last; ++column) {
            const double above = std::pow(column / (kAngles - 1.0), 2.0);
            transmittances_[static_cast<std::size_t>(row) * kAngles + static_cast<std::size_t>(column)] =
                marchedTransmittance(height, horizon + (1.0 - horizon) * above);
        }
    });
}

TableRow Atmosphere::rowOf(const double height) const {
    const double row = std::sqrt(std::min(height / kAtmosphereHeight, 1.0)) * (kHeights - 1);
    const int index = std::min(static_cast<int>(row), kHeights - 2);
    return {index, row - index, horizonCosine(height)};
}

dvec3 Atmosphere::transmittance(const TableRow& row, const double cosine) const {
    if (cosine < row.horizon) {
        return dvec3(0.0);
    }
    const double column = columnOf(row.horizon, cosine);
    const int x = std::min(static_cast<int>(column), kAngles - 2);
    const dvec3* corner =
        &transmittances_[static_cast<std::size_t>(row.index) * kAngles + static_cast<std::size_t>(x)];
    const dvec3 lower = glm::mix(corner[0], corner[1], column - x);
    const dvec3 upper = glm::mix(corner[kAngles], corner[kAngles + 1], column - x);
    return glm::mix(lower, upper, row.part);
}

SightLines::SightLines(const Atmosphere& atmosphere, const double polar, const dvec3& sun)
    : atmosphere_(atmosphere), eyeToSun_((kGroundRadius + kEyeHeight) * sun.y), steps_(kSteps) {
    const dvec3 eye(0.0, kGroundRadius + kEyeHeight, 0.0);
    const dvec3 direction(std::sin(polar), std::cos(polar), 0.0);
    const double reach = distanceToSphere(eye, direction, kTopRadius).value_or(0.0);
    dvec3 passed(1.0);
    double start = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        // The first steps are short, because the air is dense there.
        const double part = (i + 1.0) / kSteps;
        const double end = reach * part * part;
        const double length = end - start;
        Step& step = steps_[static_cast<std::size_t>(i)];
        step.distance = start + 0.5 * length;
        const dvec3 here = eye + direction * step.distance;
        const double height = heightOf(here);
        const Medium medium = atmosphere.mediumAt(height);
        const dvec3 through = glm::exp(-medium.extinction * length);
        // The integral over the step of the light scattered there, with the extinction within the step.
        const dvec3 arriving = passed * (dvec3(1.0) - through) / medium.extinction * kSunIrradiance;
        step.radius = glm::length(here);
        step.row = atmosphere.rowOf(height);
        step.rayleigh = arriving * kRayleigh * medium.rayleigh;
        step.mie = arriving * (kMieScattering * medium.mie);
        passed *= through;
        start = end;
    }
}

Scattered SightLines::scattered(const double sunCosine) const {
    Scattered sum;
    for (const Step& step : steps_) {
        const double cosine = (eyeToSun_ + step.distance * sunCosine) / step.radius;
        const dvec3 transmittance = atmosphere_.transmittance(step.row, cosine);
        sum.rayleigh += step.rayleigh * transmittance;
        sum.mie += step.mie * transmittance;
    }
    return sum;
}

// `azimuth` counts from the sun; line number i lies at i * pi / parts. The sky is the same on both sides of
// the sun.
BetweenLines betweenLines(const double azimuth, const int parts) {
    const double place = std::abs(std::remainder(azimuth, 2.0 * M_PI)) / M_PI * parts;
    const int before = std::min(static_cast<int>(place), parts - 1);
    const double part = place - before;
    const auto mirrored = [&](const int line) { return line > parts ? 2 * parts - line : std::abs(line); };
    return {{mirrored(before - 1), before, before + 1, mirrored(before + 2)},
            {-part * (part - 1.0) * (part - 2.0) / 6.0, (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0,
             -part * (part + 1.0) * (part - 2.0) / 2.0, part * (part + 1.0) * (part - 1.0) / 6.0},
            std::cos(azimuth)};
}

dvec3 radianceAlong(const Scattered& light, const double sunCosine) {
    const double rayleighPhase = 3.0 / (16.0 * M_PI) * (1.0 + sunCosine * sunCosine);
    // W. Cornette, J. Shanks, "Physically Reasonable Analytic Expression for the Single-Scattering Phase
    // Function", 1992.
    const double g = kMieAsymmetry;
    const double away = 1.0 + g * g - 2.0 * g * sunCosine;
    const double miePhase = 3.0 / (8.0 * M_PI) * (1.0 - g * g) * (1.0 + sunCosine * sunCosine) /
                            ((2.0 + g * g) * away * std::sqrt(away));
    // Between two lines of which one lies in the earth's shadow, the polynomial may fall below 0.
    return glm::max(light.rayleigh * rayleighPhase + light.mie * miePhase, dvec3(0.0));
}

} // namespace

Sky makeSky(const SkySettings& settings) {
    const double elevation = settings.sunElevation;
    const double sunAzimuth = settings.sunAzimuth;
    const dvec3 sun(std::cos(elevation) * std::cos(sunAzimuth), std::sin(elevation),
                    std::cos(elevation) * std::sin(sunAzimuth));
    // Where a line of sight leaves the air, the vertical has turned by this angle at most.
    const double turned =
        std::acos(kGroundRadius / kTopRadius) + std::acos(kGroundRadius / (kGroundRadius + kEyeHeight));
    const double zenith = M_PI / 2.0 - elevation;
    const Atmosphere atmosphere(settings.haze, std::cos(std::min(zenith + turned, M_PI)),
                                std::cos(std::max(zenith - turned, 0.0)));
    const dvec3 sunlight = atmosphere.transmittance(atmosphere.rowOf(kEyeHeight), sun.y) * kSunIrradiance;

    Sky sky;
    Environment& map = sky.environment;
    map.width = settings.resolution;
    map.height = settings.resolution;
    map.texels.resize(std::size_t{map.width} * map.height);
    const std::uint32_t skyRows = map.height / 2;
    const int parts = sun.y > 0.0 ? kAzimuths : static_cast<int>(map.width / 2);
    std::vector<BetweenLines> columns(map.width);
    for (std::uint32_t x = 0; x < map.width; ++x) {
        columns[x] = betweenLines(((x + 0.5) / map.width - 0.5) * 2.0 * M_PI - sunAzimuth, parts);
    }
    std::vector<dvec3> irradianceOfRow(skyRows, dvec3(0.0));
    tbb::parallel_for(std::uint32_t{0}, skyRows, [&](std::uint32_t y) {
        const double polar = M_PI * (y + 0.5) / map.height;
        const double level = std::sin(polar) * std::cos(elevation);
        const double height = std::cos(polar) * sun.y;
        const SightLines lines(atmosphere, polar, sun);
        std::vector<Scattered> ofLine(static_cast<std::size_t>(parts) + 1);
        for (int line = 0; line <= parts; ++line) {
            ofLine[static_cast<std::size_t>(line)] =
                lines.scattered(level * std::cos(M_PI * line / parts) + height);
        }
        const double texelArea = 2.0 * M_PI / map.width * M_PI / map.height * std::sin(polar);
        for (std::uint32_t x = 0; x < map.width; ++x) {
            Scattered light;
            for (std::size_t i = 0; i < 4; ++i) {
                const Scattered& there = ofLine[static_cast<std::size_t>(columns[x].line[i])];
                light.rayleigh += columns[x].weight[i] * there.rayleigh;
                light.mie += columns[x].weight[i] * there.mie;
            }
            const dvec3 radiance = radianceAlong(light, level * columns[x].cosine + height);
            map.texels[std::size_t{y} * map.width + x] = glm::vec3(radiance);
            irradianceOfRow[y] += radiance * (texelArea * std::cos(polar));
        }
    });
    dvec3 irradiance = sunlight * std::max(sun.y, 0.0);
    for (const dvec3& row : irradianceOfRow) {
        irradiance += row;
    }
    const glm::vec3 ground(irradiance * dvec3(settings.groundAlbedo) / M_PI);
    std::fill(map.texels.begin() + static_cast<std::ptrdiff_t>(std::size_t{skyRows} * map.width),
              map.texels.end(), ground);

    const double size = 2.0 * std::pow(std::sin(kSunRadius / 2.0), 2.0); // 1 - cosine
    sky.sun.position = glm::vec3(0.0f);
    sky.sun.kind = kLightDisc;
    sky.sun.direction = glm::vec3(sun);
    sky.sun.scale = static_cast<float>(size);
    sky.sun.strength = glm::vec3(sunlight / (2.0 * M_PI * size));
    sky.sun.offset = 0.0f;
    return sky;
}

} // namespace metamarch
