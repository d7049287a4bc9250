// SPDX-License-Identifier: MIT
// The table of all channels of a picture (AOVs, arbitrary output variables).
#pragma once
#include "metamarch/shared/film_data.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamarch {

enum class AovWriter { everyIntegrator, pathTracer }; // pathTracer: path, direct and ao
enum class AovKind { picture, work }; // work: counts of a traversal, which comparisons do not judge
// usual: written where nobody chooses; denoised: written beside what a denoiser has changed.
enum class AovUse { always, usual, asked, denoised };
// small: 16-bit floats are precise enough for a picture of smaller size.
enum class AovPrecision { small, full };

// The value of a channel of whole numbers where there is nothing.
inline constexpr std::uint32_t kNoId = 0xffffffffu;

// Where the first sample of a pixel meets the scene. It follows from the film, the camera and the scene.
struct SeenPoint {
    glm::vec3 position{0.0f}; // world space; zero for a miss
    glm::vec2 uv{0.0f};       // first set of texture coordinates
    std::uint32_t mesh = kNoId;
    std::uint32_t instance = kNoId;
    std::uint32_t material = kNoId;
    glm::vec2 motion{0.0f}; // its shift until the next frame, in pixels to the right and up
};

// All that is known of a pixel.
struct AovPixel {
    const FilmPixel& film;
    LightParts light{}; // with kFilmLight
    SeenPoint seen{};
    float missDepth = std::numeric_limits<float>::infinity(); // of Z and t where there is nothing
};

struct Aov {
    std::string_view names;   // EXR names, separated by spaces: "albedo.R albedo.G albedo.B"
    std::string_view meaning; // with its unit
    // One of the two: one component for each name, of which further ones are ignored, or a whole number.
    // Cryptomatte has neither: its channels are many (cryptomatte.h).
    glm::vec3 (*value)(const AovPixel& pixel) = nullptr;
    std::uint32_t (*id)(const AovPixel& pixel) = nullptr;
    AovUse use = AovUse::usual;
    AovWriter writer = AovWriter::everyIntegrator;
    AovPrecision precision = AovPrecision::full;
    AovKind kind = AovKind::picture;
    std::uint32_t filmParts = 0; // bits kFilm… that it needs
    bool isOfSeenPoint = false;  // it needs AovPixel::seen

    std::vector<std::string> channels() const; // the single names
    bool isCryptomatte() const { return filmParts == kFilmHits; }
    // What a user calls it: its only channel, or what its channels have before the last dot. Empty for R G B.
    std::string name() const;
};

// Returns the table in the order of a picture's channels.
std::span<const Aov> aovs();

// Returns what the primary integrator writes (everyIntegrator) or the path tracer, where nobody chooses.
std::vector<Aov> usualAovs(AovWriter writer);

// Returns the rows that `names` names, and those that a picture always has, in the order of the table. A
// single "all" stands for every row that `writer` writes. Throws Error(invalidArgument) for other names, and
// for rows that `writer` does not write.
std::vector<Aov> chooseAovs(std::span<const std::string> names, AovWriter writer);

// Returns the row of that name, which exists.
const Aov& aovNamed(std::string_view name);

// Returns the rows that hold what the rows `chosen` have before a denoiser changes them: their names are
// those of `chosen` after "noisy.".
std::vector<Aov> noisyAovs(std::span<const Aov> chosen);
inline const std::string kNoisy = "noisy.";

// Returns the bits kFilm… that the rows need.
std::uint32_t filmPartsOf(std::span<const Aov> chosen);

// Returns true for channels of rows with AovPrecision::small.
bool isSmall(std::string_view channel);

// Returns the table as text, one line per row.
std::string aovText();

} // namespace metamarch
