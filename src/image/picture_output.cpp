// SPDX-License-Identifier: MIT
#include "metamarch/image/picture_output.h"

#include "metamarch/error/error.h"
#include "metamarch/file/output_file.h"

#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace metamarch {
namespace {

// Lets OpenImageIO write into an OutputFile. OpenImageIO's own file classes do not report a full disk that
// only the last flush notices.
class OutputFileProxy final : public OIIO::Filesystem::IOProxy {
  public:
    explicit OutputFileProxy(OutputFile& output) : IOProxy("", Write), file_(output) {}

    const char* proxytype() const override { return "metamarch"; }

    std::size_t write(const void* data, std::size_t size) override {
        const std::size_t written = pwrite(data, size, m_pos);
        m_pos += static_cast<std::int64_t>(written);
        return written;
    }

    std::size_t pwrite(const void* data, std::size_t size, std::int64_t offset) override {
        return file_.write(static_cast<std::uint64_t>(offset), data, size) ? size : 0;
    }

  private:
    OutputFile& file_;
};

// A file in memory with a name, for what OpenImageIO 2.4 writes only to named files: EXRs of several parts,
// and TIFFs, of which it reads parts again while it writes.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {}
    ~MemoryFile() {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

    bool copyTo(OutputFile& file) const {
        std::vector<char> bytes(std::size_t{1} << 20);
        std::uint64_t offset = 0;
        while (true) {
            const ssize_t count = pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
            if (count <= 0) {
                return count == 0;
            }
            if (!file.write(offset, bytes.data(), static_cast<std::size_t>(count))) {
                return false;
            }
            offset += static_cast<std::uint64_t>(count);
        }
    }

  private:
    int descriptor_;
};

std::string oneLine(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

} // namespace

void writeParts(const std::filesystem::path& path, const char* format,
                const std::span<const OIIO::ImageSpec> parts,
                const std::function<std::vector<std::byte>(std::size_t part)>& pixelsOf) {
    OutputFile file(path);
    OutputFileProxy proxy(file);
    std::optional<MemoryFile> memory;
    if (parts.size() > 1 || std::string_view(format) == "tiff") {
        memory.emplace();
    }
    const std::unique_ptr<OIIO::ImageOutput> output =
        OIIO::ImageOutput::create(format, memory ? nullptr : &proxy);
    const std::string name = memory ? memory->name() : path.string();
    bool done = output != nullptr;
    for (std::size_t part = 0; done && part < parts.size(); ++part) {
        if (part > 0) {
            done = output->open(name, parts[part], OIIO::ImageOutput::AppendSubimage);
        } else if (parts.size() > 1) {
            done = output->open(name, static_cast<int>(parts.size()), parts.data());
        } else {
            done = output->open(name, parts.front());
        }
        // TypeUnknown says that the values have the types of the spec, so they are not converted.
        done = done && output->write_image(OIIO::TypeUnknown, pixelsOf(part).data());
    }
    done = output && output->close() && done;
    done = done && (!memory || memory->copyTo(file));
    if (!done && !file.failed()) {
        const std::string reason = output ? output->geterror() : OIIO::geterror();
        throw Error(ErrorKind::outputNotWritable, "cannot write " + path.string() + ": " + oneLine(reason));
    }
    file.commit();
}

} // namespace metamarch
