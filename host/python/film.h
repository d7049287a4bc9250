// SPDX-License-Identifier: MIT
// A picture that Python holds: its channels, and what its file needs besides.
#pragma once
#include "metamarch/image/denoiser.h"
#include "metamarch/image/image.h"
#include "metamarch/python/loaded_scene.h"
#include "metamarch/render/render.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace metamarch::python {

class Film {
  public:
    Film(std::shared_ptr<LoadedScene> scene, Words words, const SceneCamera& camera,
         render::RenderResult result, std::uint32_t samplesWanted, std::vector<std::string> warnings,
         std::unique_ptr<const Denoiser> denoiser);

    const Image& image() const { return image_; }
    const render::RenderResult& result() const { return result_; }
    const SceneCamera& camera() const { return camera_; }
    const std::vector<std::string>& warnings() const { return warnings_; } // one line each
    bool isComplete() const;

    // `words` are settings of Call::save. Throws what writePicture throws, and Error(invalidArgument) if the
    // path names a file that the picture was made from.
    void save(const std::string& path, const Words& words) const;
    // The pixels that a PNG of the picture has, four bytes each.
    std::vector<std::uint8_t> rgba8(const Words& words) const;

    // The sums to go on with. The film has none afterwards.
    render::FilmRun takeSums() { return std::move(result_.sums); }

  private:
    void beginPictureWork() const;

    std::shared_ptr<LoadedScene> scene_;
    Words words_;
    SceneCamera camera_;
    render::RenderResult result_;
    std::unique_ptr<const Denoiser> denoiser_; // null: the picture stays as it is
    Image image_;
    std::uint32_t samplesWanted_;
    std::vector<std::string> warnings_;
};

// Renders as `metamarch render` does. `words` are settings of Call::render; without a backend it is the gpu
// if there is a graphics processor, otherwise the cpu. If `isOnePass`, the render ends with its next pass
// over the picture, and `before` has the sums of the passes before, or is null. Ends early if `isStopped`
// becomes true. Throws what the program would report.
std::shared_ptr<Film> renderFilm(const std::shared_ptr<LoadedScene>& scene, Words words, bool isOnePass,
                                 Film* before, const std::atomic<bool>& isStopped);

} // namespace metamarch::python
