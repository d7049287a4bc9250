// SPDX-License-Identifier: MIT
// Two views that the user keeps, A and B, to compare them with each other or with the present one. The
// pictures are in KeptPictures.
#pragma once
#include "metamarch/viewer/view_camera.h"
#include "metamarch/viewer/viewer_settings.h"

#include <array>
#include <cstddef>
#include <optional>

namespace metamarch::viewer {

// What the window shows.
enum class Shown { present, a, b };
constexpr std::array<Shown, 2> kKeptSlots = {Shown::a, Shown::b};

// The index of A or B in kKeptSlots.
constexpr std::size_t indexOf(const Shown slot) { return slot == Shown::b ? 1 : 0; }

constexpr const char* nameOf(const Shown slot) {
    return slot == Shown::a ? "A" : slot == Shown::b ? "B" : "the present view";
}

struct KeptView {
    ViewCamera camera;
    Settings settings;
};

class KeptViews {
  public:
    // `slot` is A or B.
    void keep(Shown slot, const KeptView& now) { slots_[indexOf(slot)] = now; }
    bool has(Shown slot) const { return slot == Shown::present || slots_[indexOf(slot)]; }
    // Forgets A and B; the present view must be shown.
    void forget() { slots_ = {}; }

    Shown shown() const { return shown_; }
    // Returns what is shown after a flip: A and B by turns, or the only one and the present view. Without
    // either it is the present view.
    Shown next() const;

    // Shows a view that has() has. `now` is what the window has. Returns what it has from now on. Panels stay
    // as they are.
    KeptView show(Shown wanted, const KeptView& now);

    // Returns true if `now` would draw the picture that is shown; always true for the present view.
    bool isOf(const KeptView& now) const;
    // Goes on from the view that is shown, as the present one. Returns the present one of before.
    KeptView leave();

  private:
    std::array<std::optional<KeptView>, 2> slots_;
    Shown shown_ = Shown::present;
    KeptView present_; // while another is shown
};

} // namespace metamarch::viewer
