// SPDX-License-Identifier: MIT
#include "metamarch/settings/render_settings.h"

#include <fmt/format.h>

#include <cmath>

namespace metamarch {
namespace {

Setting::Access scaleAccess(float& scale) {
    return {[&scale](const std::string& text) {
                SettingList parser;
                float given = 0.0f;
                parser.number("scale", given, {.wanted = "a finite number other than 0"}, "").set(text);
                if (given == 0.0f) {
                    throw Error(ErrorKind::invalidArgument, "give a finite number other than 0");
                }
                scale = given;
            },
            [&scale] { return fmt::format("{}", scale); }};
}

} // namespace

void declareImport(SettingList& list, ImportOptions& options) {
    list.beginGroup("Scene");
    list.add("scale", Setting::Kind::value, scaleAccess(options.scale), "Multiply the scene by S").takes("S");
    list.text("variant", options.variant, "Material variant (default: the file's own materials)")
        .takes("NAME|INDEX");
    list.number("time", options.time, {.wanted = "finite seconds"},
                "Pose the animations at this time (default: as the file stands)")
        .takes("SECONDS");
    list.text("animation", options.animation, "Pose by this animation alone (default: by all)")
        .takes("NAME|INDEX")
        .needs({"time"});
    list.flag("allow-missing-textures", options.allowMissingTextures,
              "Warn of textures that cannot be read and go on without them");
}

} // namespace metamarch
