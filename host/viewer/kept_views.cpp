// SPDX-License-Identifier: MIT
#include "metamarch/viewer/kept_views.h"

#include <utility>

namespace metamarch::viewer {
namespace {

// Returns `settings` with the panels of `other`, which are no part of a picture.
Settings withPanelsOf(Settings settings, const Settings& other) {
    settings.hasPanels = other.hasPanels;
    settings.hasReadOut = other.hasReadOut;
    settings.hasHelp = other.hasHelp;
    return settings;
}

} // namespace

Shown KeptViews::next() const {
    if (has(Shown::a) && has(Shown::b)) {
        return shown_ == Shown::a ? Shown::b : Shown::a;
    }
    return shown_ != Shown::present ? Shown::present
           : has(Shown::a)          ? Shown::a
           : has(Shown::b)          ? Shown::b
                                    : Shown::present;
}

KeptView KeptViews::show(const Shown wanted, const KeptView& now) {
    if (shown_ == Shown::present) {
        present_ = now;
    }
    shown_ = wanted;
    KeptView next = wanted == Shown::present ? present_ : *slots_[indexOf(wanted)];
    next.settings = withPanelsOf(std::move(next.settings), now.settings);
    return next;
}

bool KeptViews::isOf(const KeptView& now) const {
    if (shown_ == Shown::present) {
        return true;
    }
    const KeptView& kept = *slots_[indexOf(shown_)];
    return now.camera == kept.camera && now.settings == withPanelsOf(kept.settings, now.settings);
}

KeptView KeptViews::leave() {
    shown_ = Shown::present;
    return present_;
}

} // namespace metamarch::viewer
