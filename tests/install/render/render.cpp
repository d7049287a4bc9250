// SPDX-License-Identifier: MIT
// Renders a glTF file to a picture of floats, with the path tracer on the CPU.
#include "metamarch/render/render.h"

#include "metamarch/render/picture.h"
#include "metamarch/scene/import.h"
#include "metamarch/shading/view.h"

#include <cstdio>
#include <exception>
#include <memory>

int main(const int argc, char** argv) try {
    using namespace metamarch;
    if (argc != 2) {
        std::fputs("render SCENE\n", stderr);
        return 2;
    }
    constexpr int kSide = 64;
    const auto scene = std::make_shared<const Scene>(loadScene(argv[1]));
    const render::RenderSettings settings{.path = {}, .samplesPerPixel = 4};
    render::PreparedScene prepared(scene, {});  // builds tree and table
    prepared.light(argv[1], settings.path, {}); // the scene's own lights, or a sky
    const Camera camera = makeCamera(scene->cameras.at(0), kSide, kSide);
    const Image image = render::imageOf(render::renderPicture(prepared, camera, settings));
    const std::size_t red = image.findChannel("R").value();
    std::printf("red %.4f in the centre\n", static_cast<double>(image.at(kSide / 2, kSide / 2, red)));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
