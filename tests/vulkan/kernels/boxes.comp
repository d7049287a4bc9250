// SPDX-License-Identifier: MIT
// Finds the boxes that a ray may meet; the result has one bit per box.
#version 460
#extension GL_EXT_ray_query : require
layout(local_size_x = 1) in;
layout(binding = 0) uniform accelerationStructureEXT boxes;
layout(std430, binding = 1) readonly buffer Rays { vec4 rays[]; }; // origin, direction
layout(std430, binding = 2) writeonly buffer Masks { uint masks[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, boxes, gl_RayFlagsNoneEXT, 0xff, rays[2 * i].xyz, 0.0, rays[2 * i + 1].xyz, 1e30);
    uint mask = 0;
    while (rayQueryProceedEXT(query)) {
        mask |= 1u << rayQueryGetIntersectionPrimitiveIndexEXT(query, false);
    }
    masks[i] = mask;
}
