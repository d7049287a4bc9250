// SPDX-License-Identifier: MIT
#include "metamarch/viewer/channel_picture.h"

#include "metamarch/shared/false_color.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace metamarch::viewer {
namespace {

enum class Meaning { color, direction, number, id };

Meaning meaningOf(const Aov& channel) {
    if (channel.id != nullptr) {
        return Meaning::id;
    }
    const std::string first = channel.channels().front();
    return first.ends_with("R")              ? Meaning::color
           : channel.name().starts_with("N") ? Meaning::direction
                                             : Meaning::number;
}

// The least and the greatest finite number in the channel.
struct Range {
    float least = std::numeric_limits<float>::infinity();
    float greatest = -std::numeric_limits<float>::infinity();

    void add(const float value) {
        if (std::isfinite(value)) {
            least = std::min(least, value);
            greatest = std::max(greatest, value);
        }
    }
    float partOf(const float value) const {
        return greatest > least ? (value - least) / (greatest - least) : 0.0f;
    }
};

} // namespace

std::vector<Aov> shownChannels() {
    std::vector<Aov> shown;
    std::ranges::copy_if(aovs(), std::back_inserter(shown), [](const Aov& channel) {
        return channel.use != AovUse::denoised && channel.filmParts == 0 && !channel.name().empty() &&
               channel.name() != "motion";
    });
    return shown;
}

std::vector<std::uint32_t> channelPixels(const Aov& channel, const FilmData& film,
                                         const std::span<const SeenPoint> seen, const ToneMapping& tone) {
    const Meaning meaning = meaningOf(channel);
    const auto pixelAt = [&](const std::size_t i) {
        return AovPixel{.film = film.pixels[i], .seen = seen.empty() ? SeenPoint{} : seen[i]};
    };
    const auto components = static_cast<glm::length_t>(channel.channels().size());
    Range range;
    if (meaning == Meaning::number) {
        for (std::size_t i = 0; i < film.pixels.size(); ++i) {
            const glm::vec3 value = channel.value(pixelAt(i));
            for (glm::length_t component = 0; component < components; ++component) {
                range.add(value[component]);
            }
        }
    }
    std::vector<std::uint32_t> packed;
    packed.reserve(film.pixels.size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
        if (meaning == Meaning::id) {
            const std::uint32_t id = channel.id(pixelAt(i));
            packed.push_back(id == kNoId ? packedPixel(glm::vec3(0.0f)) : packedLinear(idColor(id)));
            continue;
        }
        const glm::vec3 value = channel.value(pixelAt(i));
        switch (meaning) {
        case Meaning::color:
            packed.push_back(packedLinear(toneMapped(tone, value)));
            break;
        case Meaning::direction:
            packed.push_back(packedPixel(0.5f * value + 0.5f));
            break;
        default:
            packed.push_back(packedPixel(components == 1
                                             ? heatColor(range.partOf(value.x))
                                             : glm::vec3(range.partOf(value.x), range.partOf(value.y),
                                                         components > 2 ? range.partOf(value.z) : 0.0f)));
            break;
        }
    }
    return packed;
}

} // namespace metamarch::viewer
