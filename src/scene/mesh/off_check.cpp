// SPDX-License-Identifier: MIT
#include "metamarch/scene/mesh/mesh_check.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

namespace metamarch {
namespace {

class OffChecker {
  public:
    OffChecker(const InputFile& file, std::string_view text) : file_(file), rest_(text) {}

    MeshCounts check() {
        std::vector<std::string_view> words = nextWords("the header");
        // A prefix before OFF tells what vertices have besides three coordinates. Prefixes 4 and n change the
        // coordinates themselves and are not supported.
        if (!words[0].ends_with("OFF") || words[0].find_first_of("4n") != std::string_view::npos) {
            file_.refuse("not OFF: does not start with 'OFF'");
        }
        words.erase(words.begin());
        if (words.empty()) {
            words = nextWords("the header");
        }
        const MeshCounts counts{integer(words, 0, "the header"), integer(words, 1, "the header")};
        for (std::uint64_t i = 0; i < counts.vertices; ++i) {
            checkVertex("vertex " + std::to_string(i));
        }
        for (std::uint64_t i = 0; i < counts.faces; ++i) {
            checkFace("face " + std::to_string(i), counts.vertices);
        }
        return counts;
    }

  private:
    void checkVertex(const std::string& where) {
        const std::vector<std::string_view> words = nextWords(where);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double number = 0.0;
            if (axis >= words.size() ||
                std::from_chars(words[axis].data(), words[axis].data() + words[axis].size(), number).ec ==
                    std::errc::invalid_argument) {
                file_.refuse("OFF " + where + ": not three numbers");
            }
        }
    }

    void checkFace(const std::string& where, std::uint64_t vertexCount) {
        const std::vector<std::string_view> words = nextWords(where);
        const std::uint64_t corners = integer(words, 0, where);
        if (corners == 0 || corners >= words.size()) {
            file_.refuse("OFF " + where + ": has " + std::to_string(corners) + " corners, but " +
                         std::to_string(words.size() - 1) + " numbers");
        }
        for (std::uint64_t corner = 1; corner <= corners; ++corner) {
            if (const std::uint64_t index = integer(words, corner, where); index >= vertexCount) {
                file_.refuse("OFF " + where + ": index " + std::to_string(index) +
                             " is out of range, there are " + std::to_string(vertexCount) + " vertices");
            }
        }
    }

    // Returns the words of the next line that has any before its '#'.
    std::vector<std::string_view> nextWords(const std::string& where) {
        constexpr std::string_view kBlank = " \t\r";
        std::vector<std::string_view> words;
        while (words.empty()) {
            if (rest_.empty()) {
                file_.refuse("OFF " + where + ": the file ends here");
            }
            std::string_view line = rest_.substr(0, rest_.find('\n'));
            rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
            line = line.substr(0, line.find('#'));
            for (std::size_t begin; (begin = line.find_first_not_of(kBlank)) != std::string_view::npos;) {
                line.remove_prefix(begin);
                words.push_back(line.substr(0, line.find_first_of(kBlank)));
                line.remove_prefix(words.back().size());
            }
        }
        return words;
    }

    std::uint64_t integer(const std::vector<std::string_view>& words, std::size_t i,
                          const std::string& where) const {
        std::uint64_t number = 0;
        if (i >= words.size() ||
            std::from_chars(words[i].data(), words[i].data() + words[i].size(), number).ec != std::errc()) {
            file_.refuse("OFF " + where + ": number " + std::to_string(i) + " is missing or no count");
        }
        return number;
    }

    const InputFile& file_;
    std::string_view rest_;
};

} // namespace

MeshCounts checkOff(const InputFile& file, std::string_view bytes) { return OffChecker(file, bytes).check(); }

} // namespace metamarch
