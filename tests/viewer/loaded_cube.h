// SPDX-License-Identifier: MIT
// A unit cube as the viewer holds a scene, and a camera before it.
#pragma once
#include "fixtures/shapes.h"
#include "metamarch/shading/view.h"
#include "metamarch/viewer/scene_loader.h"

#include <memory>

namespace metamarch::viewer {

inline LoadedScene loadedCube() {
    Scene cube = tests::unitCube();
    cube.meshes.resize(1);
    cube.meshes.front().name = "cube";
    cube.triangleMesh.assign(cube.triangles.size(), 0);
    cube.triangleMaterial.assign(cube.triangles.size(), kNoMaterial);
    const auto whole = std::make_shared<const Scene>(cube);
    return {.request = {},
            .whole = whole,
            .shown = render::PreparedScene(whole, {}),
            .bounds = {{0, 0, 0}, {1, 1, 1}}};
}

// Looks along -z at the middle of the cube, 3 units before its face.
inline Camera beforeCube() {
    SceneCamera camera;
    camera.eye = {0.5f, 0.5f, 4.0f};
    return makeCamera(camera, 200, 200);
}

} // namespace metamarch::viewer
