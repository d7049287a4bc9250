// SPDX-License-Identifier: MIT
// The step at an inner node that all walks down the kd-tree share. The loops are in traversal/kd_*.glsl and
// their CPU twins.
#ifndef METAMARCH_SHARED_KD_WALK_H
#define METAMARCH_SHARED_KD_WALK_H
#include "kd_node.h"
#include "ray.h"

SHARED_BEGIN

SHARED_FN float component(const vec3 v, const uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

// Returns the t at which the ray crosses the plane with the lattice coordinate `plane`.
SHARED_FN float crossPlane(const Ray ray, const uint axis, const uint plane) {
    const float t = (float(plane) - component(ray.start, axis)) * component(ray.invStride, axis);
    return t;
}

// An inner node, seen from a ray's interval [tNear, tFar].
struct KdFork {
    // The child that contains the ray's start; if the start is on the plane, the child that the ray comes
    // from.
    uint nearChild;
    uint farChild;
    float tSplit;
    bool meetsNear; // the interval meets the near child, the far child, or both
    bool meetsFar;
};

// An interval that begins on the plane belongs to the far child: a walk that restarts at the root with
// tNear = tSplit must not enter the near child again.
SHARED_FN KdFork forkAt(const Ray ray, const uint nodeId, const KdNode node, const float tNear,
                        const float tFar) {
    const uint axis = splitAxis(node);
    const float plane = float(splitPlane(node));
    const float start = component(ray.start, axis);
    const bool belowIsNear = start < plane || (start == plane && component(ray.invStride, axis) > 0.0f);

    KdFork fork;
    fork.nearChild = belowIsNear ? nodeId + 1u : childAbove(node);
    fork.farChild = belowIsNear ? childAbove(node) : nodeId + 1u;
    fork.tSplit = crossPlane(ray, axis, splitPlane(node));
    const bool nearOnly = fork.tSplit >= tFar || fork.tSplit < 0.0f;
    fork.meetsNear = nearOnly || fork.tSplit > tNear;
    fork.meetsFar = !nearOnly;
    return fork;
}

SHARED_END
#endif
