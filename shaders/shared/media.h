// SPDX-License-Identifier: MIT
// The volumes that a path is inside of, for volumes within volumes.
//
// C. M. Schmidt, B. Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2),
// 2002: where volumes overlap, one of them has priority and fills the overlap; surfaces of the others are no
// interfaces there. glTF has no priorities, so the volume that the path has entered last has priority.
// Volumes that touch should overlap a little: of two triangles in the same place a ray meets only one.
#ifndef METAMARCH_SHARED_MEDIA_H
#define METAMARCH_SHARED_MEDIA_H
#include "interop.h"

SHARED_BEGIN

// A medium is the interior of a volume: the index of its material plus 1.
const uint kNoMedium = 0u;

SHARED_FN uint mediumOf(const uint material) { return material + 1u; }
SHARED_FN uint materialOf(const uint medium) { return medium - 1u; }

// The media that a path is inside of, the one entered last first, then kNoMedium. A medium is there once for
// each of its volumes. If a path enters more than four, the one entered first is forgotten.
struct Media {
    uint first;
    uint second;
    uint third;
    uint fourth;
};

SHARED_FN Media noMedia() { return Media(kNoMedium, kNoMedium, kNoMedium, kNoMedium); }

SHARED_FN bool isInside(const Media media, const uint medium) {
    return media.first == medium || media.second == medium || media.third == medium || media.fourth == medium;
}

SHARED_FN Media enterMedium(const Media media, const uint medium) {
    return Media(medium, media.first, media.second, media.third);
}

// Adds the medium of a path that has been inside since its start: all others were entered later.
SHARED_FN Media enclosedBy(const Media media, const uint medium) {
    const bool is1 = media.first == kNoMedium;
    const bool is2 = !is1 && media.second == kNoMedium;
    const bool is3 = !is1 && !is2 && media.third == kNoMedium;
    const bool is4 = !is1 && !is2 && !is3 && media.fourth == kNoMedium;
    return Media(is1 ? medium : media.first, is2 ? medium : media.second, is3 ? medium : media.third,
                 is4 ? medium : media.fourth);
}

// Removes the medium once.
SHARED_FN Media leaveMedium(const Media media, const uint medium) {
    const bool is1 = media.first == medium;
    const bool is2 = is1 || media.second == medium;
    const bool is3 = is2 || media.third == medium;
    const bool is4 = is3 || media.fourth == medium;
    return Media(is1 ? media.second : media.first, is2 ? media.third : media.second,
                 is3 ? media.fourth : media.third, is4 ? kNoMedium : media.fourth);
}

// Returns the media behind the surface of a volume, which the path meets from outside or from inside.
SHARED_FN Media crossSurface(const Media media, const uint medium, const bool isBack) {
    return isBack ? leaveMedium(media, medium) : enterMedium(media, medium);
}

// Returns whether a path inside `media` meets an interface where it arrives at the surface of a volume of
// `material`: not if another volume fills both sides, or one of the same material.
SHARED_FN bool isInterface(const Media media, const uint medium, const bool isBack) {
    return isBack ? media.first == medium && media.second != medium : media.first != medium;
}

// Returns the medium on the far side of an interface that a path meets from inside, or the one that it is in
// outside.
SHARED_FN uint mediumOutside(const Media media, const bool isBack) {
    return isBack ? media.second : media.first;
}

SHARED_END
#endif
