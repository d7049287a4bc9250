// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>

namespace metamarch {
namespace {

Setting::Access scaleAccess(float& scale) {
    return {[&scale](const std::string& text) {
                const NumberRange range{.wanted = "a finite number other than 0"};
                const float given = parseFloat(text, range);
                if (given == 0.0f) {
                    throw Error(ErrorKind::invalidArgument, "give " + range.wanted);
                }
                scale = given;
            },
            [&scale] { return fmt::format("{}", scale); }};
}

} // namespace

void declareImport(SettingList& list, ImportOptions& options) {
    list.beginGroup("Scene");
    list.add("scale", Setting::Kind::value, scaleAccess(options.scale), "Multiply the scene by S")
        .withValueName("S");
    list.text("scene", options.scene, "Scene of a file that has several (default: the file's own choice)")
        .withValueName("NAME|INDEX");
    list.text("variant", options.variant, "Material variant (default: the file's own materials)")
        .withValueName("NAME|INDEX");
    list.number("time", options.time, {.wanted = "finite seconds"},
                "Pose the animations at this time (default: as the file stands)")
        .withValueName("SECONDS");
    list.text("animation", options.animation, "Pose by this animation alone (default: by all)")
        .withValueName("NAME|INDEX")
        .needs({"time"});
    list.flag("allow-missing-textures", options.allowMissingTextures,
              "Warn of textures that cannot be read and go on without them");
}

} // namespace metamarch
