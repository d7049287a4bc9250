// SPDX-License-Identifier: MIT
// A scene in memory with all that its pictures share: structure, light, and copies on devices.
#pragma once
#include "metamarch/python/open_device.h"
#include "metamarch/python/options.h"
#include "metamarch/render/prepared_scene.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace metamarch::python {

// Keeps its device open.
struct SceneOnDevice {
    std::shared_ptr<OpenDevice> owner;
    render::DeviceScene scene;
};

// Any number of threads may use one scene.
class LoadedScene {
  public:
    // Throws what loadScene throws. `words` are settings of Call::load.
    LoadedScene(const std::string& path, Words words);
    // The bytes of a GLB, which `name` stands for in messages.
    LoadedScene(const std::string& name, std::vector<unsigned char> glb, Words words);

    const Scene& scene() const { return *scene_; }
    const Words& words() const { return words_; }
    // As the header of a picture has it: "-" for bytes, like a scene from standard input.
    const std::string& path() const { return path_; }
    const std::string& sha1() const { return sha1_; } // of the file; empty for bytes

    // The scene with its structure. Throws what buildAccelerationStructure throws.
    render::PreparedScene prepared();
    // The same, lit for `options`; `primary` needs no light.
    render::PreparedScene lit(const cli::RenderOptions& options);
    // Keeps the copy that was made last.
    std::shared_ptr<SceneOnDevice> on(const std::shared_ptr<OpenDevice>& device,
                                      const render::PreparedScene& scene);

  private:
    struct Light {
        ShadingOptions shading;
        bool isOcclusion;
        LightChoice choice;

        bool operator==(const Light&) const = default;
    };

    render::PreparedScene preparedLocked();

    Words words_;
    std::string path_;
    std::string name_;
    std::string sha1_;
    std::shared_ptr<const Scene> scene_;
    std::mutex mutex_;
    std::optional<render::PreparedScene> prepared_; // lit by light_, if that is set
    std::optional<Light> light_;
    std::shared_ptr<SceneOnDevice> onDevice_;
};

} // namespace metamarch::python
