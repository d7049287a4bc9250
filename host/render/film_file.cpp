// SPDX-License-Identifier: MIT
#include "metamarch/render/film_file.h"

#include "metamarch/file/content_hash.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <utility>

namespace metamarch::render {
namespace {

using Json = nlohmann::ordered_json;

// A file is this preamble, the description as JSON, and the runs in their order: the films of their spans,
// each as FilmPixel[], LightParts[] and first hits, and then SeenPoint[], in little-endian order. First hits
// are the number of HitCounts of each pixel, and then the HitCounts. Another layout gets another number.
constexpr std::array<char, 24> kMagic = {"metamarch sums 4\n"};
struct Preamble {
    std::array<char, 24> magic;
    std::uint64_t descriptionBytes;
    std::uint64_t filmBytes;
    std::uint64_t hash; // of the description and of each array
};
static_assert(sizeof(Preamble) == 48 && std::endian::native == std::endian::little);
static_assert(sizeof(SeenPoint) == 40);

constexpr std::uint64_t kMostDescription = std::uint64_t{64} << 20u;

// First hits as the file has them; none if the film has none.
std::vector<std::uint32_t> hitWordsOf(const FilmData& film) {
    std::vector<std::uint32_t> words;
    words.reserve(film.hits.size());
    for (const std::vector<HitCount>& hits : film.hits) {
        words.push_back(static_cast<std::uint32_t>(hits.size()));
    }
    for (const std::vector<HitCount>& hits : film.hits) {
        for (const HitCount& hit : hits) {
            words.push_back(hit.group);
            words.push_back(hit.samples);
        }
    }
    return words;
}

// Returns false where the words are no first hits of the film's pixels.
bool setHits(const std::vector<std::uint32_t>& words, FilmData& film) {
    const std::size_t pixels = film.pixels.size();
    film.hits.resize(pixels);
    std::size_t next = pixels;
    for (std::size_t pixel = 0; pixel < pixels && next <= words.size(); ++pixel) {
        const std::size_t count = words[pixel];
        if (count > (words.size() - next) / 2) {
            return false;
        }
        for (std::size_t i = 0; i < count; ++i, next += 2) {
            film.hits[pixel].push_back({words[next], words[next + 1]});
        }
    }
    return next == words.size();
}

Json described(const FilmFile& file, const std::span<const FilmRun> films) {
    Json facts = Json::array();
    for (const auto& [name, value] : file.facts) {
        facts.push_back({name, value});
    }
    Json runs = Json::array();
    for (const FilmRun& run : films) {
        Json spans = Json::array();
        for (const FilmSpan& span : run.spans) {
            spans.push_back({{"firstSample", span.firstSample},
                             {"light", !span.film->light.empty()},
                             {"hitWords", hitWordsOf(*span.film).size()}});
        }
        runs.push_back({{"area", {run.area.left, run.area.top, run.area.right, run.area.bottom}},
                        {"spans", std::move(spans)},
                        {"seen", !run.seen.empty()}});
    }
    Json levels = Json::array();
    for (const CryptomatteLevel& level : file.cryptomatte) {
        levels.push_back({{"layer", level.layer}, {"names", level.nameOfGroup}});
    }
    return {{"facts", std::move(facts)},
            {"sceneFile", file.sceneFile},
            {"size", {file.width, file.height}},
            {"cryptomatte", std::move(levels)},
            {"runs", std::move(runs)}};
}

// The film file without its films, which have their sizes. Throws what nlohmann::json throws.
FilmFile undescribed(const Json& json) {
    FilmFile file;
    for (const Json& fact : json.at("facts")) {
        file.facts.emplace_back(fact.at(0).get<std::string>(), fact.at(1).get<std::string>());
    }
    file.sceneFile = json.at("sceneFile").get<std::string>();
    file.width = json.at("size").at(0).get<std::uint32_t>();
    file.height = json.at("size").at(1).get<std::uint32_t>();
    for (const Json& level : json.at("cryptomatte")) {
        file.cryptomatte.push_back(
            {level.at("layer").get<std::string>(), level.at("names").get<std::vector<std::string>>()});
    }
    for (const Json& run : json.at("runs")) {
        const auto area = run.at("area").get<std::array<std::uint32_t, 4>>();
        file.runs.push_back({{area[0], area[1], area[2], area[3]}, {}});
        for (const Json& span : run.at("spans")) {
            file.runs.back().spans.push_back({span.at("firstSample").get<std::uint32_t>(), {}});
        }
    }
    return file;
}

bool isWithin(const PixelRect& area, const FilmFile& file) {
    return area.left < area.right && area.right <= file.width && area.top < area.bottom &&
           area.bottom <= file.height;
}

class Reader {
  public:
    explicit Reader(const std::filesystem::path& path) : file_(path), stream_(path, std::ios::binary) {}

    FilmFile read() {
        std::error_code failure;
        const std::uint64_t size = std::filesystem::file_size(file_.path(), failure);
        Preamble preamble{};
        if (failure || size < sizeof(Preamble) || !get(std::as_writable_bytes(std::span(&preamble, 1))) ||
            preamble.magic != kMagic) {
            file_.refuse("is no checkpoint or part that this version reads");
        }
        if (preamble.descriptionBytes > kMostDescription ||
            size - sizeof(Preamble) != preamble.descriptionBytes + preamble.filmBytes ||
            preamble.filmBytes > size) {
            file_.refuse("is cut off or damaged");
        }
        std::string text(preamble.descriptionBytes, ' ');
        get(std::as_writable_bytes(std::span(text)));
        hash_.addAll(text);
        FilmFile film = readFilms(text, preamble.filmBytes);
        if (!stream_ || hash_.value() != preamble.hash) {
            file_.refuse("is cut off or damaged");
        }
        return film;
    }

  private:
    bool get(const std::span<std::byte> bytes) {
        stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return static_cast<bool>(stream_);
    }

    FilmFile readFilms(const std::string& text, std::uint64_t bytesLeft) {
        try {
            const Json json = Json::parse(text);
            FilmFile film = undescribed(json);
            if (film.width == 0 || film.height == 0) {
                file_.refuse("is cut off or damaged");
            }
            for (std::size_t i = 0; i < film.runs.size(); ++i) {
                FilmRun& run = film.runs[i];
                if (!isWithin(run.area, film)) {
                    file_.refuse("is cut off or damaged");
                }
                for (std::size_t j = 0; j < run.spans.size(); ++j) {
                    const Json& span = json["runs"][i]["spans"][j];
                    const bool hasLight = span.at("light").get<bool>();
                    const auto hitWords = span.at("hitWords").get<std::uint64_t>();
                    const std::uint64_t pixelBytes = sizeof(FilmPixel) + (hasLight ? sizeof(LightParts) : 0);
                    if (run.area.pixelCount() > bytesLeft / pixelBytes ||
                        hitWords > (bytesLeft - run.area.pixelCount() * pixelBytes) / sizeof(std::uint32_t)) {
                        file_.refuse("is cut off or damaged");
                    }
                    bytesLeft -= run.area.pixelCount() * pixelBytes + hitWords * sizeof(std::uint32_t);
                    FilmData sums;
                    readFilm(run.area.pixelCount(), hasLight, hitWords, sums);
                    requireGroups(sums, film);
                    run.spans[j] = {run.spans[j].firstSample, std::move(sums)};
                }
                if (json["runs"][i].at("seen").get<bool>()) {
                    if (run.area.pixelCount() > bytesLeft / sizeof(SeenPoint)) {
                        file_.refuse("is cut off or damaged");
                    }
                    bytesLeft -= run.area.pixelCount() * sizeof(SeenPoint);
                    run.seen.resize(run.area.pixelCount());
                    get(std::as_writable_bytes(std::span(run.seen)));
                    hash_.addAll(run.seen);
                }
            }
            if (bytesLeft != 0) {
                file_.refuse("is cut off or damaged");
            }
            return film;
        } catch (const nlohmann::json::exception&) {
            file_.refuse("is cut off or damaged");
        }
    }

    void readFilm(const std::size_t pixelCount, const bool hasLight, const std::size_t hitWords,
                  FilmData& film) {
        film.pixels.resize(pixelCount);
        film.light.resize(hasLight ? pixelCount : 0);
        std::vector<std::uint32_t> words(hitWords);
        get(std::as_writable_bytes(std::span(film.pixels)));
        get(std::as_writable_bytes(std::span(film.light)));
        get(std::as_writable_bytes(std::span(words)));
        hash_.addAll(film.pixels);
        hash_.addAll(film.light);
        hash_.addAll(words);
        if (hitWords > 0 && !setHits(words, film)) {
            file_.refuse("is cut off or damaged");
        }
    }

    // Every group that a pixel names has a name in each level.
    void requireGroups(const FilmData& film, const FilmFile& file) {
        for (const std::vector<HitCount>& hits : film.hits) {
            for (const HitCount& hit : hits) {
                if (file.cryptomatte.empty() ||
                    std::ranges::any_of(file.cryptomatte, [&](const CryptomatteLevel& level) {
                        return hit.group >= level.nameOfGroup.size();
                    })) {
                    file_.refuse("is cut off or damaged");
                }
            }
        }
    }

    InputFile file_;
    std::ifstream stream_;
    ContentHash hash_;
};

} // namespace

std::optional<std::string> differingFact(const FilmFacts& here, const FilmFacts& there) {
    for (const auto& [facts, others] : {std::pair(&here, &there), std::pair(&there, &here)}) {
        for (const auto& fact : *facts) {
            if (std::ranges::find(*others, fact) == others->end()) {
                return fact.first;
            }
        }
    }
    return std::nullopt;
}

std::string factNamed(const FilmFacts& facts, const std::string_view name) {
    const auto found = std::ranges::find(facts, name, &FilmFacts::value_type::first);
    return found == facts.end() ? "" : found->second;
}

FilmFileBytes::FilmFileBytes(const FilmFile& file, const std::span<const FilmRun> runs) {
    // A driver may call its device by bytes that are no UTF-8.
    const std::string text = described(file, runs).dump(-1, ' ', false, Json::error_handler_t::replace);
    ContentHash hash;
    hash.addAll(text);
    Preamble preamble{.magic = kMagic, .descriptionBytes = text.size(), .filmBytes = 0, .hash = 0};
    pieces_.emplace_back(); // the head, once it is there
    for (const FilmRun& run : runs) {
        for (const FilmSpan& span : run.spans) {
            hitWords_.push_back(hitWordsOf(*span.film));
            for (const auto bytes :
                 {std::as_bytes(std::span(span.film->pixels)), std::as_bytes(std::span(span.film->light)),
                  std::as_bytes(std::span(std::as_const(hitWords_).back()))}) {
                hash.add(bytes);
                preamble.filmBytes += bytes.size();
                pieces_.push_back(bytes);
            }
        }
        if (!run.seen.empty()) {
            const auto seen = std::as_bytes(std::span(run.seen));
            hash.add(seen);
            preamble.filmBytes += seen.size();
            pieces_.push_back(seen);
        }
    }
    preamble.hash = hash.value();
    const auto first = std::as_bytes(std::span(&preamble, 1));
    const auto second = std::as_bytes(std::span(text));
    head_.assign(first.begin(), first.end());
    head_.insert(head_.end(), second.begin(), second.end());
    pieces_.front() = head_;
}

void writeFilmFile(const FilmFile& file, const std::span<const FilmRun> runs,
                   const std::filesystem::path& path) {
    OutputFile output(path);
    std::uint64_t offset = 0;
    const FilmFileBytes bytes(file, runs);
    for (const std::span<const std::byte> piece : bytes.pieces()) {
        output.write(offset, piece.data(), piece.size());
        offset += piece.size();
    }
    output.commit();
}

FilmFile readFilmFile(const std::filesystem::path& path) { return Reader(path).read(); }

} // namespace metamarch::render
