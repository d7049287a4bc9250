#include "scene/import.h"

#include "error.h"
#include "scene/gltf_import.h"
#include "scene/mesh_import.h"
#include "scene/scene_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>

namespace metamarch {
namespace {

std::string lowerCaseEnding(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

Scene import(SceneFile& file, double scale) {
    const std::string ending = lowerCaseEnding(file.path());
    if (ending == ".gltf" || ending == ".glb")
        return importGltf(file, scale);
    if (ending == ".obj" || ending == ".ply" || ending == ".off" || ending == ".stl")
        return importMesh(file, ending, scale);
    file.refuse("the ending '" + ending + "' is none of .gltf .glb .obj .ply .off .stl");
}

} // namespace

Scene loadScene(const std::filesystem::path& path, float scale) {
    SceneFile file(path);
    if (!std::isfinite(scale) || scale == 0.0f)
        file.refuse("scale " + std::to_string(scale) + " is zero or not finite");
    try {
        Scene scene = import(file, static_cast<double>(scale));
        scene.warnings = file.takeWarnings();
        return scene;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        file.refuseSize("not enough memory for the scene");
    } catch (const std::length_error&) {
        file.refuseSize("not enough memory for the scene");
    } catch (const std::exception& failure) {
        // The libraries throw what they like at broken files.
        file.refuse(failure.what());
    }
}

} // namespace metamarch
