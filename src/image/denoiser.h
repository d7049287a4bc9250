// SPDX-License-Identifier: MIT
// Removes noise from pictures with Open Image Denoise 2 (https://www.openimagedenoise.org), which is loaded
// when it is first wanted: nobody else has to install it.
#pragma once
#include <glm/glm.hpp>

#include <memory>
#include <string>
#include <vector>

namespace metamarch {

// The pixels of pictures of one size, row by row from the top.
struct DenoiserGuides {
    std::vector<glm::vec3> albedo;  // 0 to 1
    std::vector<glm::vec3> normals; // shading normals, -1 to 1
};

class Denoiser {
  public:
    // Throws Error(invalidArgument) about the setting "denoise" if the library is not installed.
    Denoiser();
    ~Denoiser();
    Denoiser(Denoiser&&) noexcept;
    Denoiser& operator=(Denoiser&&) noexcept;

    std::string version() const; // "Open Image Denoise 2.5.1"

    // The guides without their own noise.
    DenoiserGuides filterGuides(DenoiserGuides guides, int width, int height) const;

    // Returns the picture `color`, of linear radiance, without its noise. `guides` are what filterGuides
    // returned. Results depend on the processor and the version. Throws Error(outOfMemory) or Error(noDevice)
    // about the setting "denoise" if the library fails; so does filterGuides.
    std::vector<glm::vec3> filterColor(const std::vector<glm::vec3>& color, const DenoiserGuides& guides,
                                       int width, int height) const;

  private:
    struct Library;
    std::unique_ptr<Library> library_;
};

} // namespace metamarch
