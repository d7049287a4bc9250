// SPDX-License-Identifier: MIT
// What `metamarch view` is asked for. The programs differ in what answers it: view_in_window.cpp or
// view_elsewhere.cpp.
#pragma once
#include "metamarch/cli/picture_options.h"

#include <string>

namespace metamarch::cli {

struct ViewOptions : PictureOptions {
    ViewOptions() : PictureOptions(1024) {}

    std::string secondTraversal;
    std::string shown; // a name of render::kViewNames; empty: the picture
    std::string shaderFolder;
    bool hasNoPanels = false;
    bool hasTour = false;
};

// Opens the window, and returns when the user closes it. Throws Error(noDevice) without a viewer.
void runView(const ViewOptions& options);

} // namespace metamarch::cli
