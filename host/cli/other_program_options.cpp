// SPDX-License-Identifier: MIT
#include "metamarch/cli/other_program_options.h"

#include <algorithm>
#include <cctype>
#include <span>

namespace metamarch::cli {
namespace {

struct Answer {
    std::string_view words; // without dashes before, with blanks between
    std::string_view answer;
};

constexpr Answer kAnswers[] = {
    {"n sample-count samples-per-pixel pixelsamples num-samples render-samples spp-count", "`--spp`"},
    {"width height w h r res resolution resolution-x resolution-y dimensions image-size window-size "
     "film-size "
     "geometry",
     "`--size WxH`"},
    {"o out outfile outputfile output-file output-path render-output save", "`--output`"},
    {"envmap env-map environment environment-map environment-texture hdri hdri-file hdr ibl world skybox",
     "`--env`"},
    {"hdri-rotation envmap-rotation environment-rotation", "`--env-rotation`"},
    {"envmap-strength env-strength environment-intensity hdri-intensity world-strength light-intensity",
     "`--env-intensity`"},
    {"max-depth maxdepth depth bounces max-bounce total-bounces light-bounces rr-depth path-depth",
     "`--max-bounces`"},
    {"bg bg-color bgcolor background-color background-colour world-color", "`--background r,g,b`"},
    {"camera-position camera-pos cam-pos position pos origin from look-from lookfrom camera-eye eye-position",
     "`--eye x,y,z`"},
    {"look-at lookat at to camera-target camera-focal-point focal-point camera-lookat aim",
     "`--target x,y,z`"},
    {"camera-up view-up camera-view-up up-direction up-vector", "`--up x,y,z`"},
    {"fov field-of-view camera-view-angle view-angle fovy yfov camera-fov", "`--vfov`"},
    {"cam camera-index camera-name active-camera", "`--camera NAME|INDEX`"},
    {"ortho camera-orthographic orthographic-scale", "`--orthographic HEIGHT`"},
    {"fstop f-stop lens-radius aperture-radius dof", "`--aperture R`"},
    {"focal-distance focus focus-dist", "`--focus-distance`"},
    {"shadow-plane ground-plane ground floor catcher catch-shadows", "`--shadow-catcher`"},
    {"gpu", "`--backend gpu`"},
    {"cpu", "`--backend cpu`"},
    {"gpu-device gpu-index device-index device-id adapter", "`--device`"},
    {"E engine render-engine renderer", "`--integrator`"},
    {"ambient-occlusion ao", "`--integrator ao`"},
    {"frame f t-frame frame-number animation-time animation-frame", "`--time SECONDS`"},
    {"animation-index animation-name", "`--animation`"},
    {"verbose v debug log-level loglevel", "`--verbose`"},
    {"quiet q silent", "`--quiet`"},
    {"threads t j jobs nthreads num-threads thread-count cpus", "`--threads`"},
    {"tonemap tonemapping tone-mapping tonemapper view-transform", "`--tone-map`"},
    {"ev gain", "`--exposure STOPS`"},
    {"sun-direction sun-position", "`--sun x,y,z`"},
    {"random-seed rng-seed", "`--seed`"},
    {"pixel-filter rfilter reconstruction-filter", "`--filter`"},
    {"material-variant", "`--variant`"},
    {"clamp-indirect clamp-direct sample-clamp firefly-clamp", "`--clamp`"},
    {"statistics timings profile", "`--stats`"},
    {"threshold tolerance epsilon", "`--max-abs`"},
    {"i in input file scene scene-file model mesh", "the scene is given without an option"},
    {"list-devices devices gpus list-gpus", "`metamarch devices` lists them"},
    {"F file-format output-format image-format",
     "the ending of the picture's name says it; for standard output there is `--format`"},
    {"aovs passes channels layers outputs", "`--aov`"},
    {"bit-depth color-depth depth", "`--bits`"},
    {"gamma", "a PNG is always encoded as sRGB, and an EXR is linear"},
    {"half-float float16 fp16", "`--half`"},
    {"denoiser oidn", "`--denoise`"},
    {"film-transparent no-background alpha transparency", "`--transparent`"},
    {"cropwindow crop-window border region", "`--crop x0,y0,x1,y1`"},
    {"timeout max-time render-time", "`--time-limit SECONDS`"},
    {"save-every write-interval", "`--write-every SECONDS`"},
    {"config preferences settings", "there is no file of settings; options are given each time"},
    {"log log-file", "warnings and errors go to standard error: 2> FILE"},
    {"V version", "`metamarch --version` prints the version"},
};

// Returns "max-depth" for "--Max_Depth=5". A single letter keeps its case, because -V and -v differ.
std::string plain(std::string_view option) {
    option.remove_prefix(std::min(option.find_first_not_of('-'), option.size()));
    std::string word(option.substr(0, option.find('=')));
    if (word.size() > 1) {
        std::ranges::transform(word, word.begin(), [](const unsigned char c) {
            return c == '_' ? '-' : static_cast<char>(std::tolower(c));
        });
    }
    return word;
}

bool hasWord(std::string_view words, const std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (words.substr(0, end) == word) {
            return true;
        }
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

} // namespace

std::string_view answerTo(const std::string_view option) {
    std::string word = plain(option);
    const auto find = [&] {
        return std::ranges::find_if(kAnswers,
                                    [&](const Answer& known) { return hasWord(known.words, word); });
    };
    auto found = find();
    if (found == std::end(kAnswers) && word.size() == 1) { // -W is -w, where -w is known
        word[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[0])));
        found = find();
    }
    return found == std::end(kAnswers) || word.empty() ? "" : found->answer;
}

} // namespace metamarch::cli
