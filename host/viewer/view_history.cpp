// SPDX-License-Identifier: MIT
#include "metamarch/viewer/view_history.h"

namespace metamarch::viewer {
namespace {

constexpr double kStillSeconds = 0.5;
constexpr std::size_t kMostViews = 1000;

} // namespace

void ViewHistory::start(const ViewCamera& first) {
    views_ = {first};
    current_ = 0;
    last_ = first;
    stillFor_ = 0.0;
}

void ViewHistory::follow(const ViewCamera& now, const double seconds) {
    stillFor_ = now == last_ ? stillFor_ + seconds : 0.0;
    last_ = now;
    if (stillFor_ >= kStillSeconds) {
        keep(now);
    }
}

// A new view ends what could be done again.
void ViewHistory::keep(const ViewCamera& view) {
    if (view == views_[current_]) {
        return;
    }
    views_.resize(current_ + 1);
    views_.push_back(view);
    if (views_.size() > kMostViews) {
        views_.erase(views_.begin() + 1); // the first view stays
    }
    current_ = views_.size() - 1;
}

std::optional<ViewCamera> ViewHistory::undo(const ViewCamera& now) {
    keep(now);
    if (current_ == 0) {
        return std::nullopt;
    }
    return last_ = views_[--current_];
}

std::optional<ViewCamera> ViewHistory::redo() {
    if (current_ + 1 == views_.size()) {
        return std::nullopt;
    }
    return last_ = views_[++current_];
}

} // namespace metamarch::viewer
