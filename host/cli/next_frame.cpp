// SPDX-License-Identifier: MIT
#include "metamarch/cli/next_frame.h"

namespace metamarch::cli {

render::NextFrame nextFrame(const RenderOptions& options, const Scene& scene, const SceneCamera& camera,
                            const SceneAt& sceneAt) {
    ImportOptions later = options.import;
    later.time = *later.time + 1.0 / options.frameRate;
    const std::shared_ptr<const Scene> next = sceneAt(later);
    render::checkNextFrame(scene, *next);
    const glm::vec2 size(options.size);
    const bool isOfFile = !options.view.eye && !next->cameras.empty();
    const SceneCamera moved = isOfFile ? chooseCamera(*next, options.view, size.x / size.y) : camera;
    return {next, makeCamera(moved, options.size.x, options.size.y, options.view.lens)};
}

} // namespace metamarch::cli
