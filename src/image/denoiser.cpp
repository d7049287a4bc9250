// SPDX-License-Identifier: MIT
#include "metamarch/image/denoiser.h"

#include "metamarch/error/error.h"

#include <fmt/format.h>

#include <cstddef>
#include <dlfcn.h>
#include <stdexcept>
#include <string_view>

namespace metamarch {
namespace {

// From the C interface of Open Image Denoise 2, whose header is not needed to build.
constexpr const char* kLibrary = "libOpenImageDenoise.so.2";
constexpr int kCpuDevice = 1; // others may not see our memory
constexpr int kOutOfMemory = 4;
constexpr int kFloat3 = 3;
using Device = void*;
using Filter = void*;

struct CloseLibrary {
    void operator()(void* const handle) const { dlclose(handle); }
};

[[noreturn]] void refuse(const std::string& reason) {
    throw Error(ErrorKind::invalidArgument,
                fmt::format("Open Image Denoise 2 cannot be loaded ({}); `tools/setup --denoise` installs it",
                            reason),
                {"denoise"});
}

std::string lastFault() {
    const char* const fault = dlerror();
    return fault != nullptr ? fault : "no reason is known";
}

} // namespace

struct Denoiser::Library {
    Library() : handle(dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL)) {
        if (!handle) {
            refuse(lastFault());
        }
        find("oidnNewDevice", newDevice);
        find("oidnCommitDevice", commitDevice);
        find("oidnReleaseDevice", releaseDevice);
        find("oidnGetDeviceError", deviceError);
        find("oidnGetDeviceInt", deviceInt);
        find("oidnSetDeviceBool", setDeviceBool);
        find("oidnNewFilter", newFilter);
        find("oidnSetSharedFilterImage", setImage);
        find("oidnSetFilterBool", setFilterBool);
        find("oidnCommitFilter", commitFilter);
        find("oidnExecuteFilter", executeFilter);
        find("oidnReleaseFilter", releaseFilter);
        device = newDevice(kCpuDevice);
        if (device != nullptr) {
            setDeviceBool(device, "setAffinity", false); // threads belong to the whole program
            commitDevice(device);
        }
        const char* fault = nullptr;
        if (deviceError(device, &fault) != 0) {
            const std::string reason = fault != nullptr ? fault : "it has no device";
            release();
            refuse(reason);
        }
    }
    ~Library() { release(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    void release() {
        if (device != nullptr) {
            releaseDevice(device);
            device = nullptr;
        }
    }

    template <typename Function>
    void find(const char* const name, Function*& function) {
        function = reinterpret_cast<Function*>(dlsym(handle.get(), name));
        if (function == nullptr) {
            refuse(lastFault());
        }
    }

    std::unique_ptr<void, CloseLibrary> handle;
    Device (*newDevice)(int type) = nullptr;
    void (*commitDevice)(Device) = nullptr;
    void (*releaseDevice)(Device) = nullptr;
    int (*deviceError)(Device, const char** message) = nullptr;
    int (*deviceInt)(Device, const char* name) = nullptr;
    void (*setDeviceBool)(Device, const char* name, bool value) = nullptr;
    Filter (*newFilter)(Device, const char* type) = nullptr;
    void (*setImage)(Filter, const char* name, void* pixels, int format, std::size_t width,
                     std::size_t height, std::size_t byteOffset, std::size_t bytesOfPixel,
                     std::size_t bytesOfRow) = nullptr;
    void (*setFilterBool)(Filter, const char* name, bool value) = nullptr;
    void (*commitFilter)(Filter) = nullptr;
    void (*executeFilter)(Filter) = nullptr;
    void (*releaseFilter)(Filter) = nullptr;
    Device device = nullptr;
};

namespace {

// One run of the filter for ray-traced pictures.
template <typename Library>
class FilterRun {
  public:
    FilterRun(const Library& library, const int width, const int height)
        : library_(library), filter_(library.newFilter(library.device, "RT")), width_(width),
          height_(height) {}
    ~FilterRun() { library_.releaseFilter(filter_); }
    FilterRun(const FilterRun&) = delete;
    FilterRun& operator=(const FilterRun&) = delete;

    void setImage(const char* const name, const std::vector<glm::vec3>& pixels) {
        const auto width = static_cast<std::size_t>(width_);
        const auto height = static_cast<std::size_t>(height_);
        if (pixels.size() != width * height) {
            throw std::invalid_argument("Denoiser: a picture has another size");
        }
        // The library changes the picture "output" alone.
        library_.setImage(filter_, name, const_cast<glm::vec3*>(pixels.data()), kFloat3, width, height, 0, 0,
                          0);
    }
    void set(const char* const name) { library_.setFilterBool(filter_, name, true); }

    void execute() {
        library_.commitFilter(filter_);
        library_.executeFilter(filter_);
        const char* fault = nullptr;
        const int error = library_.deviceError(library_.device, &fault);
        if (error != 0) {
            throw Error(error == kOutOfMemory ? ErrorKind::outOfMemory : ErrorKind::noDevice,
                        fmt::format("Open Image Denoise: {}", fault != nullptr ? fault : "it has failed"),
                        {"denoise"});
        }
    }

  private:
    const Library& library_;
    Filter filter_;
    int width_;
    int height_;
};

} // namespace

Denoiser::Denoiser() : library_(std::make_unique<Library>()) {}
Denoiser::~Denoiser() = default;
Denoiser::Denoiser(Denoiser&&) noexcept = default;
Denoiser& Denoiser::operator=(Denoiser&&) noexcept = default;

std::string Denoiser::version() const {
    const int version = library_->deviceInt(library_->device, "version"); // 20501 is 2.5.1
    return fmt::format("Open Image Denoise {}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

DenoiserGuides Denoiser::filterGuides(DenoiserGuides guides, const int width, const int height) const {
    DenoiserGuides filtered = guides;
    for (const auto& [name, noisy, clean] : {std::tuple{"albedo", &guides.albedo, &filtered.albedo},
                                             std::tuple{"normal", &guides.normals, &filtered.normals}}) {
        FilterRun run(*library_, width, height);
        run.setImage(name, *noisy);
        run.setImage("output", *clean);
        run.execute();
    }
    return filtered;
}

std::vector<glm::vec3> Denoiser::filterColor(const std::vector<glm::vec3>& color,
                                             const DenoiserGuides& guides, const int width,
                                             const int height) const {
    std::vector<glm::vec3> clean(color.size());
    FilterRun run(*library_, width, height);
    run.setImage("color", color);
    run.setImage("albedo", guides.albedo);
    run.setImage("normal", guides.normals);
    run.setImage("output", clean);
    run.set("hdr");
    run.set("cleanAux");
    run.execute();
    return clean;
}

} // namespace metamarch
