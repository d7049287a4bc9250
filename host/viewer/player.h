// SPDX-License-Identifier: MIT
// Moves on what plays: the animations of the scene, and the steps of a march, also while each step is saved.
#pragma once
#include "metamarch/viewer/viewer_state.h"

#include <string>

namespace metamarch::viewer {

class Player {
  public:
    // Poses the scene at the next time. Call it once per frame in which the last pose is there or waits.
    // `seconds` have passed since the last call.
    void playAnimations(double seconds, bool isWaiting, ViewerState& state);

    // Shows the next step of a march that plays, or the one that is to be saved.
    void playMarch(double seconds, ViewerState& state);

    // Begins to save each step of the march. Says so if there is none.
    void saveMarch(ViewerState& state);
    bool isSaving() const { return isSaving_; }
    // The step that is shown has been saved as `path`.
    void stepIsSaved(const std::string& path, ViewerState& state);
    void stopSaving() { isSaving_ = false; }

  private:
    double sincePose_ = 0.0; // seconds since an animation was posed last
    double sinceStep_ = 0.0; // seconds since the march has played its last step
    bool isSaving_ = false;  // the step that is shown is saved next
    int savedSteps_ = 0;     // of that march
};

} // namespace metamarch::viewer
