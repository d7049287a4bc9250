// SPDX-License-Identifier: MIT
// Stands in for Open Image Denoise 2, which the tests do not install. Its filter returns the mean of the
// picture: the right answer for a wall of one colour. Guides stay as they are. What the real library would
// refuse, or would filter badly without, is an error.
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

namespace {

struct Image {
    float* pixels;
    std::size_t count;
};

struct FakeFilter {
    std::map<std::string, Image> images;
    std::set<std::string> flags;
    bool isCommitted = false;
};

int device;
const char* fault = nullptr;

void keep(const Image& from, const Image& to) {
    for (std::size_t i = 0; i < 3 * from.count; ++i) {
        to.pixels[i] = from.pixels[i];
    }
}

void average(const Image& from, const Image& to) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double sum = 0.0;
        for (std::size_t i = 0; i < from.count; ++i) {
            sum += static_cast<double>(from.pixels[3 * i + channel]);
        }
        for (std::size_t i = 0; i < to.count; ++i) {
            to.pixels[3 * i + channel] = static_cast<float>(sum / static_cast<double>(from.count));
        }
    }
}

FakeFilter& filterOf(void* const handle) { return *static_cast<FakeFilter*>(handle); }

} // namespace

extern "C" {

void* oidnNewDevice(const int type) {
    fault = type == 1 ? nullptr : "only the processor sees the program's memory";
    return &device;
}
void oidnCommitDevice(void*) {}
void oidnReleaseDevice(void*) {}
int oidnGetDeviceInt(void*, const char* const name) { return std::string(name) == "version" ? 21703 : -1; }
void oidnSetDeviceBool(void*, const char*, bool) {}

int oidnGetDeviceError(void*, const char** const message) {
    const bool isBad = fault != nullptr;
    *message = fault;
    fault = nullptr;
    return isBad ? 3 : 0;
}

void* oidnNewFilter(void*, const char* const type) {
    fault = std::string(type) == "RT" ? fault : "the filter is not RT";
    return new FakeFilter;
}

void oidnSetSharedFilterImage(void* const filter, const char* const name, void* const pixels,
                              const int format, const std::size_t width, const std::size_t height,
                              const std::size_t byteOffset, const std::size_t bytesOfPixel,
                              const std::size_t bytesOfRow) {
    if (format != 3 || byteOffset + bytesOfPixel + bytesOfRow != 0) {
        fault = "a picture is not of three floats";
    }
    filterOf(filter).images[name] = {static_cast<float*>(pixels), width * height};
}

void oidnSetFilterBool(void* const filter, const char* const name, const bool value) {
    if (value) {
        filterOf(filter).flags.insert(name);
    }
}

void oidnCommitFilter(void* const filter) { filterOf(filter).isCommitted = true; }

void oidnExecuteFilter(void* const handle) {
    const FakeFilter& filter = filterOf(handle);
    const auto& images = filter.images;
    if (std::getenv("METAMARCH_FAKE_FAULT") != nullptr) {
        fault = "asked to fail";
        return;
    }
    if (!filter.isCommitted || !images.contains("output")) {
        fault = "the filter is not ready";
    } else if (images.contains("color")) {
        if (!images.contains("albedo") || !images.contains("normal") ||
            filter.flags != std::set<std::string>{"cleanAux", "hdr"}) {
            fault = "a colour lacks its guides";
            return;
        }
        average(images.at("color"), images.at("output"));
    } else if (images.size() == 2 && filter.flags.empty()) { // output, and one guide
        keep(images.begin()->first == "output" ? images.rbegin()->second : images.begin()->second,
             images.at("output"));
    } else {
        fault = "a guide is filtered by itself";
    }
}

void oidnReleaseFilter(void* const filter) { delete &filterOf(filter); }
}
