// SPDX-License-Identifier: MIT
#include "metamarch/scene/import.h"

#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/scene/gltf/import.h"
#include "metamarch/scene/mesh/mesh_import.h"

#include <cmath>
#include <new>
#include <system_error>

namespace metamarch {
namespace {

Scene import(InputFile& file, const ImportOptions& options) {
    const std::string ending = lowerCaseEnding(file.path());
    if (ending == ".gltf" || ending == ".glb" || file.isInMemory()) {
        return importGltf(file, options);
    }
    if (ending == ".obj" || ending == ".ply" || ending == ".off" || ending == ".stl") {
        return importMesh(file, ending, options);
    }
    file.refuse("the ending '" + ending + "' is none of .gltf .glb .obj .ply .off .stl");
}

Scene load(InputFile& file, const ImportOptions& options) {
    if (!std::isfinite(options.scale) || options.scale == 0.0f) {
        file.refuse("scale " + std::to_string(options.scale) + " is zero or not finite");
    }
    try {
        Scene scene = import(file, options);
        scene.files = file.files();
        scene.warnings = file.takeWarnings();
        return scene;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        file.refuseSize("not enough memory for the scene");
    } catch (const std::length_error&) {
        file.refuseSize("not enough memory for the scene");
    } catch (const std::system_error& failure) {
        if (failure.code() == std::errc::resource_unavailable_try_again) {
            throw; // no thread to read it with, which is not the file's fault
        }
        file.refuse(failure.what());
    } catch (const std::exception& failure) {
        // The libraries throw various exceptions for broken files.
        file.refuse(failure.what());
    }
}

} // namespace

Scene loadScene(const std::filesystem::path& path, const ImportOptions& options) {
    InputFile file(path);
    return load(file, options);
}

Scene loadGlb(const std::string& name, std::vector<unsigned char> glb, const ImportOptions& options) {
    InputFile file(name, std::move(glb));
    return load(file, options);
}

} // namespace metamarch
