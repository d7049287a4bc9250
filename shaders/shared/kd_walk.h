// SPDX-License-Identifier: MIT
// What every walk down the kd-tree does at an inner node; the loops are in traversal/kd_*.glsl and their CPU
// twins.
#ifndef METAMARCH_SHARED_KD_WALK_H
#define METAMARCH_SHARED_KD_WALK_H
#include "kd_node.h"
#include "ray.h"

SHARED_BEGIN

SHARED_FN float component(const vec3 v, const uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

// Where the ray crosses the plane of lattice coordinate `plane`.
SHARED_FN float crossPlane(const Ray ray, const uint axis, const uint plane) {
    const float t = (float(plane) - component(ray.start, axis)) * component(ray.invStride, axis);
    return t;
}

// An inner node as the ray's interval [tNear, tFar] meets it.
struct KdFork {
    uint nearChild; // holds the ray's start; of a start on the plane, the child that the ray comes from
    uint farChild;
    float tSplit;
    bool meetsNear; // one of the two, or both
    bool meetsFar;
};

// An interval that begins on the plane is all on the far side: a walk that comes back from the root to
// tNear = tSplit must not find the near child again.
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
