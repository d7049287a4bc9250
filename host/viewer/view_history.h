// SPDX-License-Identifier: MIT
// The views that the user has had, to go back to them.
#pragma once
#include "metamarch/viewer/view_camera.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace metamarch::viewer {

class ViewHistory {
  public:
    // Begins with the first view of a scene.
    void start(const ViewCamera& first);

    // Call it once per frame with the present view. A view counts once it has stood still for half a second;
    // what a drag passes through does not. `seconds` have passed since the last call.
    void follow(const ViewCamera& now, double seconds);

    // Return the view before `now`, or the one that undo() has left; nothing where there is none.
    std::optional<ViewCamera> undo(const ViewCamera& now);
    std::optional<ViewCamera> redo();

    const ViewCamera& first() const { return views_.front(); }

  private:
    void keep(const ViewCamera& view);

    std::vector<ViewCamera> views_{ViewCamera()};
    std::size_t current_ = 0; // index of the view that is shown, or from which the user is moving away
    ViewCamera last_;
    double stillFor_ = 0.0; // seconds
};

} // namespace metamarch::viewer
