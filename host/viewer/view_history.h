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

    // Call it once per frame with the present view. A view counts if it has stood still for half a second, or
    // if it is kept; what a drag passes through does not count. `seconds` have passed since the last call.
    void follow(const ViewCamera& now, double seconds);

    // Keeps a view that a key or button is about to replace.
    void keep(const ViewCamera& view);

    // Return the view before `now`, or the one that undo() has left; nothing where there is none.
    std::optional<ViewCamera> undo(const ViewCamera& now);
    std::optional<ViewCamera> redo();

    const ViewCamera& first() const { return views_.front(); }

  private:
    std::vector<ViewCamera> views_{ViewCamera()};
    std::size_t current_ = 0; // index of the view that is shown, or from which the user is moving away
    ViewCamera last_;
    double stillFor_ = 0.0; // seconds
};

} // namespace metamarch::viewer
