// SPDX-License-Identifier: MIT
// A small box for each reference of a leaf. A ray that misses the box within the leaf's exit box need not
// test the triangle.
//
// The box contains the part of the triangle in the exit box, with the margin. A leaf's frame contains its
// boxes. src/accel/README.md says why no hit is lost.
//
// The march reads a leaf from a record: entries of 16 bytes that lie side by side, so that they share cache
// lines. The first entry is the LeafHead; a leaf without triangles has no other. The LeafFrame follows, then
// the boxes and then as many indices of triangle records, both in groups of four, because on lavapipe each
// load costs the same, whatever its size. The table's words name the first entry.
#ifndef METAMARCH_SHARED_REFERENCE_BOX_H
#define METAMARCH_SHARED_REFERENCE_BOX_H
#include "interval.h"
#include "ray.h"

SHARED_BEGIN

// Frames lie on 1/64 of a cell, so that a position in the largest lattice has 16 bits.
const uint kFrameStepsPerCell = 64u;
const float kFrameStep = 0.015625f; // in cells

struct LeafHead {
    uint lo;     // packCell; the exit box
    uint hi;     // packCell, exclusive
    uint leafId; // names the leaf in views
    uint triangleCount;
};

// The frame of a leaf's boxes. For each axis: where it begins, in 16 bits, and above them its length, at
// least 1; both in steps.
struct LeafFrame {
    uint x;
    uint y;
    uint z;
    uint firstIndices; // the entry of the leaf's first group of indices
};

// `record` is the first entry of a leaf's record.
SHARED_FN uint frameEntry(const uint record) { return record + 1u; }
SHARED_FN uint firstBoxes(const uint record) { return record + 2u; }

SHARED_FN uint packFrameAxis(const uint first, const uint length) { return first | (length << 16u); }

// A box is rounded outwards to parts of the frame, kBoxParts on each axis. Its word has six numbers of five
// bits: lo.x, lo.y, lo.z, hi.x, hi.y, hi.z.
const uint kBoxParts = 31u;
const float kFrameStepsToParts = 5.040322430431843e-4f; // kFrameStep / kBoxParts

// No ray meets this box, because its lo is above its hi. It fills the last group of a leaf.
const uint kNoBox = 0x00007fffu;
const uint kWholeFrame = 0x3fff8000u;

const uint kBoxesPerGroup = 4u; // a group is one entry
// The candidates of a leaf are bits of a word, so a longer leaf is tested in several rounds.
const uint kMostCandidates = 32u;

SHARED_FN uint packReferenceBox(const uvec3 lo, const uvec3 hi) {
    return lo.x | (lo.y << 5u) | (lo.z << 10u) | (hi.x << 15u) | (hi.y << 20u) | (hi.z << 25u);
}

// Returns, per axis, where a box's word has the plane that the ray meets first.
SHARED_FN uvec3 nearPlaneShift(const Ray ray) {
    return uvec3(ray.invStride.x > 0.0f ? 0u : 15u, ray.invStride.y > 0.0f ? 5u : 20u,
                 ray.invStride.z > 0.0f ? 10u : 25u);
}

// A frame along a ray: t of plane i is tLow + i * tPart.
struct FrameCrossing {
    vec3 tLow;
    vec3 tPart;
};

SHARED_FN FrameCrossing crossFrame(const Ray ray, const LeafFrame frame) {
    const vec3 low = vec3(int(frame.x & 0xffffu), int(frame.y & 0xffffu), int(frame.z & 0xffffu));
    const vec3 size = vec3(int(frame.x >> 16u), int(frame.y >> 16u), int(frame.z >> 16u));
    return FrameCrossing((low * kFrameStep - ray.start) * ray.invStride,
                         (size * kFrameStepsToParts) * ray.invStride);
}

// Returns the interval of t in which the ray is in the box and in [span.x, span.y]; if it is empty, the first
// number is the larger one. `shift` is nearPlaneShift.
SHARED_FN vec2 crossReferenceBox(const FrameCrossing frame, const uvec3 shift, const uint box,
                                 const vec2 span) {
    const float nearX = frame.tLow.x + float(int((box >> shift.x) & kBoxParts)) * frame.tPart.x;
    const float nearY = frame.tLow.y + float(int((box >> shift.y) & kBoxParts)) * frame.tPart.y;
    const float nearZ = frame.tLow.z + float(int((box >> shift.z) & kBoxParts)) * frame.tPart.z;
    const float farX = frame.tLow.x + float(int((box >> (15u - shift.x)) & kBoxParts)) * frame.tPart.x;
    const float farY = frame.tLow.y + float(int((box >> (25u - shift.y)) & kBoxParts)) * frame.tPart.y;
    const float farZ = frame.tLow.z + float(int((box >> (35u - shift.z)) & kBoxParts)) * frame.tPart.z;
    return vec2(larger(larger(nearX, nearY), larger(nearZ, span.x)),
                smaller(smaller(farX, farY), smaller(farZ, span.y)));
}

// Returns one bit for each of a group's boxes: whether the ray meets it within the span.
SHARED_FN uint meetBoxes(const FrameCrossing frame, const uvec3 shift, const uvec4 boxes, const vec2 span) {
    const vec2 a = crossReferenceBox(frame, shift, boxes.x, span);
    const vec2 b = crossReferenceBox(frame, shift, boxes.y, span);
    const vec2 c = crossReferenceBox(frame, shift, boxes.z, span);
    const vec2 d = crossReferenceBox(frame, shift, boxes.w, span);
    return (a.x <= a.y ? 1u : 0u) | (b.x <= b.y ? 2u : 0u) | (c.x <= c.y ? 4u : 0u) | (d.x <= d.y ? 8u : 0u);
}

#ifdef __cplusplus
static_assert(kMaxLatticeResolution * kFrameStepsPerCell <= 0xffffu, "a frame's numbers have 16 bits");
#endif
SHARED_ASSERT_SIZE(LeafFrame, 16)
SHARED_ASSERT_OFFSET(LeafFrame, firstIndices, 12)
SHARED_ASSERT_SIZE(LeafHead, 16)
SHARED_ASSERT_OFFSET(LeafHead, hi, 4)
SHARED_ASSERT_OFFSET(LeafHead, leafId, 8)
SHARED_ASSERT_OFFSET(LeafHead, triangleCount, 12)

SHARED_END
#endif
