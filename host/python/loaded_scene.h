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

// Copies the scene to the device. Throws what DeviceScene throws.
std::shared_ptr<SceneOnDevice> putOnDevice(const std::shared_ptr<OpenDevice>& device,
                                           const render::PreparedScene& scene);

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
    // The same, lit for `options` with the ground that they choose, whose material comes into path.catcher.
    // `primary` needs no light. Throws what placeCatcher throws.
    render::PreparedScene lit(const cli::RenderOptions& options, PathChoice& path);
    // The scene read once more with other options. Keeps what it read last.
    std::shared_ptr<const Scene> at(const ImportOptions& import);
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

    struct Prepared {
        std::optional<render::PreparedScene> scene;
        std::optional<Light> light; // of `scene`, if it has any
    };

    Prepared& preparedLocked();
    Prepared& groundedLocked(const CatcherChoice& choice);
    Scene read(const ImportOptions& import) const;

    Words words_;
    std::string path_;
    std::string name_;
    std::string sha1_;
    std::optional<std::vector<unsigned char>> glb_; // where there is no file
    std::shared_ptr<const Scene> scene_;
    std::mutex mutex_;
    Prepared prepared_;
    Prepared grounded_; // with the plane of groundChoice_, whose material is ground_
    CatcherChoice groundChoice_;
    std::uint32_t ground_ = 0;
    std::shared_ptr<const Scene> later_; // at the time of laterTime_
    std::optional<double> laterTime_;
    std::shared_ptr<SceneOnDevice> onDevice_;
};

} // namespace metamarch::python
