// SPDX-License-Identifier: MIT
#include "metamarch/viewer/pixel_readout.h"

#include "metamarch/image/aov.h"
#include "metamarch/shared/screen.h"
#include "metamarch/viewer/pick.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace metamarch::viewer {
namespace {

std::string valueText(const Aov& channel, const AovPixel& pixel) {
    if (channel.id != nullptr) {
        const std::uint32_t id = channel.id(pixel);
        return id == kNoId ? "none" : fmt::to_string(id);
    }
    const glm::vec3 value = channel.value(pixel);
    std::string text;
    for (std::size_t i = 0; i < channel.channels().size(); ++i) {
        text += fmt::format("{}{:.5g}", i > 0 ? " " : "", value[static_cast<glm::length_t>(i)]);
    }
    return text;
}

std::string orNumber(const std::string& name, const std::uint32_t number) {
    return name.empty() ? fmt::to_string(number) : fmt::format("{} {}", number, name);
}

} // namespace

std::vector<std::string> channelLines(const FilmPixel& pixel) {
    if (pixel.samples == 0) {
        return {"no samples yet"};
    }
    std::vector<std::string> lines;
    for (const Aov& channel : aovs()) {
        const bool isOfFilm =
            channel.filmParts == 0 && !channel.isOfSeenPoint && channel.use != AovUse::denoised;
        if (isOfFilm) {
            const std::string name = channel.name();
            lines.push_back(
                fmt::format("{:<13}{}", name.empty() ? "R G B" : name, valueText(channel, {.film = pixel})));
        }
    }
    return lines;
}

std::vector<std::string> hitLines(const LoadedScene& scene, const Camera& camera, const glm::vec2 place) {
    const std::optional<Pick> found = pick(scene, camera, place);
    if (!found) {
        return {"the ray hits nothing"};
    }
    const MarchLog march = logMarch(*scene.shown.structure, rayThrough(scene, camera, place));
    std::vector<std::string> lines = {
        fmt::format("{:<13}{} of mesh {}", "triangle", found->triangleId,
                    orNumber(scene.whole->meshes[found->mesh].name, found->mesh)),
        fmt::format("{:<13}{:.5g} {:.5g} {:.5g}", "point", found->position.x, found->position.y,
                    found->position.z),
        fmt::format("{:<13}{:.5g}", "distance", found->distance)};
    if (found->material != kNoMaterial) {
        lines.push_back(fmt::format("{:<13}{}", "material",
                                    orNumber(scene.whole->materials[found->material].name, found->material)));
    }
    if (!march.steps.empty()) {
        const MarchStep& last = march.steps.back();
        lines.push_back(fmt::format("{:<13}({}, {}, {}), leaf {}", "cell", last.cell.x, last.cell.y,
                                    last.cell.z, last.leafId));
    }
    return lines;
}

std::vector<std::string> readOutLines(const ViewerState& state, const SplitView& shown) {
    const std::optional<glm::uvec2> under = state.pixelUnderCursor();
    if (!state.settings.hasReadOut || !under) {
        return {};
    }
    const glm::uvec2 pixel = *under;
    std::vector<std::string> lines = {fmt::format("pixel {}, {}", pixel.x, pixel.y)};
    if (!shown.isEmpty() && !state.settings.view && state.kept.shown() == Shown::present) {
        const ProgressiveImage& film = shown.under(pixel.x, state.settings.splitAt);
        const glm::uvec2 place(pixelUnder(pixel.x, film.size().x, state.size.x),
                               pixelUnder(pixel.y, film.size().y, state.size.y));
        std::ranges::move(channelLines(film.filmPixel(place)), std::back_inserter(lines));
    }
    std::ranges::move(hitLines(*state.scene, state.traced(), glm::vec2(pixel) + 0.5f),
                      std::back_inserter(lines));
    return lines;
}

} // namespace metamarch::viewer
