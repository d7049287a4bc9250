// SPDX-License-Identifier: MIT
#include "metamarch/cli/checkpoint.h"
#include "metamarch/cli/commands.h"
#include "metamarch/cli/output_check.h"
#include "metamarch/cli/render_command.h"
#include "metamarch/error/error.h"
#include "metamarch/file/input_file.h"
#include "metamarch/file/output_file.h"
#include "metamarch/file/standard_stream.h"
#include "metamarch/image/image_file.h"
#include "metamarch/render/film_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

namespace metamarch::cli {
namespace {

struct MergeOptions {
    std::vector<std::string> parts;
    std::string outputPath;
    bool quiet = false;
};

// A span of one of the files.
struct Piece {
    std::string file;
    PixelRect area;
    const render::FilmSpan* span;
    const render::FilmRun* run; // of the span

    std::uint32_t endSample() const { return span->firstSample + span->film->samples(); }
};

[[noreturn]] void refuseOtherChannels(const std::string& a, const std::string& b) {
    throw Error(ErrorKind::inputRefused, fmt::format("{} and {} hold sums of other channels", a, b));
}

// In the order of samples, whatever the order of the files.
std::vector<Piece> piecesOf(const std::vector<std::string>& names,
                            const std::vector<render::FilmFile>& files) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (const render::FilmRun& run : files[i].runs) {
            for (const render::FilmSpan& span : run.spans) {
                if (!pieces.empty() && span.film->parts() != pieces.front().span->film->parts()) {
                    refuseOtherChannels(pieces.front().file, names[i]);
                }
                pieces.push_back({names[i], run.area, &span, &run});
            }
        }
    }
    std::ranges::stable_sort(pieces, {}, [](const Piece& piece) {
        return std::tuple(piece.span->firstSample, piece.area.top, piece.area.left);
    });
    return pieces;
}

// Throws Error(inputRefused) by the names of two files that hold the same sample.
void requireNoOverlap(const std::vector<Piece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Piece& a = pieces[j];
            const Piece& b = pieces[i];
            const std::uint32_t left = std::max(a.area.left, b.area.left);
            const std::uint32_t top = std::max(a.area.top, b.area.top);
            const bool isApart = left >= std::min(a.area.right, b.area.right) ||
                                 top >= std::min(a.area.bottom, b.area.bottom) ||
                                 b.span->firstSample >= a.endSample() || b.endSample() == b.span->firstSample;
            if (!isApart) {
                throw Error(ErrorKind::inputRefused,
                            fmt::format("{} and {} both have sample {} of pixel {},{}", a.file, b.file,
                                        b.span->firstSample, left, top));
            }
        }
    }
}

[[noreturn]] void refuseMissing(const std::uint32_t sample, const std::uint32_t x, const std::uint32_t y) {
    throw Error(ErrorKind::inputRefused, fmt::format("no part has sample {} of pixel {},{}", sample, x, y));
}

// Throws Error(inputRefused) by the first pixel of the picture that no piece has from sample 0 on. A file may
// claim any size, so this comes before memory is taken for the picture. The pieces do not overlap.
void requireCovered(const std::vector<Piece>& pieces, const PixelRect& picture) {
    std::vector<PixelRect> areas;
    std::size_t covered = 0;
    // Left and above of the first pixel that is missing is the border of the picture or of an area.
    std::set<std::uint32_t> columns{0};
    std::set<std::uint32_t> rows{0};
    for (const Piece& piece : pieces) {
        if (piece.span->firstSample == 0 && piece.span->film->samples() > 0) {
            areas.push_back(piece.area);
            covered += piece.area.pixelCount();
            columns.insert(piece.area.right);
            rows.insert(piece.area.bottom);
        }
    }
    if (covered == picture.pixelCount()) {
        return;
    }
    for (const std::uint32_t y : rows) {
        for (const std::uint32_t x : columns) {
            const bool isMissing = std::ranges::none_of(areas, [&](const PixelRect& area) {
                return area.left <= x && x < area.right && area.top <= y && y < area.bottom;
            });
            if (x < picture.right && y < picture.bottom && isMissing) {
                refuseMissing(0, x, y);
            }
        }
    }
}

// Throws Error(inputRefused) where samples are missing.
std::pair<FilmData, std::uint32_t> sumOf(const std::vector<Piece>& pieces, const PixelRect& picture) {
    requireCovered(pieces, picture);
    render::FilmSum sum(picture, pieces.empty() ? 0 : pieces.front().span->film->parts());
    std::uint32_t most = 1;
    for (const Piece& piece : pieces) {
        if (!sum.add(piece.area, *piece.span)) {
            const auto pixel = static_cast<std::uint32_t>(sum.failed());
            const std::uint32_t x = piece.area.left + pixel % piece.area.width();
            const std::uint32_t y = piece.area.top + pixel / piece.area.width();
            if (sum.samples(x, y) != piece.span->firstSample) {
                refuseMissing(sum.samples(x, y), x, y);
            }
            throw Error(ErrorKind::inputRefused, piece.file + ": holds sums that no render makes");
        }
        most = std::max(most, piece.endSample());
    }
    for (std::uint32_t y = 0; y < picture.bottom; ++y) {
        for (std::uint32_t x = 0; x < picture.right; ++x) {
            if (sum.samples(x, y) < most) {
                refuseMissing(sum.samples(x, y), x, y);
            }
        }
    }
    return {sum.take(), most};
}

// What the first samples of the picture's pixels see, if the parts know it. The pieces cover the picture.
std::vector<SeenPoint> seenIn(const std::vector<Piece>& pieces, const PixelRect& picture) {
    std::vector<SeenPoint> seen;
    for (const Piece& piece : pieces) {
        if (piece.span->firstSample != 0) {
            break;
        }
        if (piece.run->seen.empty() != pieces.front().run->seen.empty()) {
            refuseOtherChannels(pieces.front().file, piece.file);
        }
        if (piece.run->seen.empty()) {
            continue;
        }
        seen.resize(picture.pixelCount());
        const std::size_t width = piece.area.width();
        for (std::uint32_t y = piece.area.top; y < piece.area.bottom; ++y) {
            const auto* const row = piece.run->seen.data() + (y - piece.area.top) * width;
            std::copy_n(row, width, seen.data() + std::size_t{y} * picture.width() + piece.area.left);
        }
    }
    return seen;
}

void runMerge(const MergeOptions& options) {
    const bool isPart = lowerCaseEnding(options.outputPath) == ".part";
    if (isPart) {
        const OutputFile probe(options.outputPath);
    } else {
        checkWritable(options.outputPath, {});
    }
    std::vector<NamedFile> inputs;
    std::vector<render::FilmFile> files;
    for (const std::string& name : options.parts) {
        inputs.push_back({name, name});
        files.push_back(render::readFilmFile(name));
        requireSamePicture(files.front(), options.parts.front(), files.back(), name);
    }
    const NamedFile output[] = {{"--output", options.outputPath}};
    checkOutputsDiffer(output, inputs);

    const std::vector<Piece> pieces = piecesOf(options.parts, files);
    requireNoOverlap(pieces);
    // The header of a picture names the scene as the part with the first sample does.
    const std::string& first = pieces.empty() ? options.parts.front() : pieces.front().file;
    const auto firstFile = std::ranges::find(options.parts, first) - options.parts.begin();
    const render::FilmFile& head = files[static_cast<std::size_t>(firstFile)];
    const render::FilmFile merged{head.facts, head.sceneFile, head.width, head.height, head.cryptomatte, {}};
    std::string what;
    if (isPart) {
        std::vector<render::FilmRun> runs;
        for (render::FilmFile& file : files) {
            std::ranges::move(file.runs, std::back_inserter(runs));
        }
        render::writeFilmFile(merged, runs, options.outputPath);
        what = "a part of several";
    } else {
        const PixelRect picture{0, 0, merged.width, merged.height};
        auto [film, samples] = sumOf(pieces, picture);
        writeMerged(merged, first, std::move(film), seenIn(pieces, picture), samples, options.outputPath);
        what = fmt::format("{} samples a pixel", samples);
    }
    if (!options.quiet && !isStandardOutput(options.outputPath)) {
        printSummary(fmt::format("{}: {} x {}, {}\n", options.outputPath, merged.width, merged.height, what));
    }
}

} // namespace

Command makeMergeCommand() {
    const auto options = std::make_shared<MergeOptions>();
    Command command{"merge", "Put the parts of a picture together", {}, {}, {}, {}};
    SettingList& settings = command.settings;
    settings.positionals(
        "PART", options->parts,
        "Files that `render` wrote with --samples or --crop and the output .part, or as a checkpoint");
    settings
        .text("output", options->outputPath,
              "Picture to write, as of `render`; .part: sums to merge with further parts")
        .withShortName("o")
        .withValueName("FILE")
        .required();
    settings.flag("quiet", options->quiet, "Print nothing but errors and warnings");
    command.footer =
        "The picture has the bytes of one that is rendered at once. The order of the parts does not "
        "matter.\n\n"
        "Example:\n  build/metamarch merge build/a.part build/b.part -o build/cornell.exr";
    command.run = [options](const SettingList&) { runMerge(*options); };
    return command;
}

} // namespace metamarch::cli
