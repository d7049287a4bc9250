// SPDX-License-Identifier: MIT
// Traces the ray through a pixel's centre, one invocation per pixel, and shows the content of the meta table
// at the hit. It needs the table anyway, so it always uses the march, whatever traversal draws the other
// views.
#include "lib/picture.glsl"
#include "shared/cells.h"
#include "traversal/meta_table.glsl"

uint leafBeside(const ivec3 cell) {
    return isInLattice(cell, lattice.resolution) ? loadHead(wordAt(cell, lattice.resolution)).leafId
                                                 : kNoLeaf;
}

CellFacts loadCellFacts(const CellPlace place) {
    const LeafHead leaf = loadHead(wordAt(place.cell, lattice.resolution));
    const uvec3 beside = uvec3(leafBeside(place.cell + ivec3(place.side.x, 0, 0)),
                               leafBeside(place.cell + ivec3(0, place.side.y, 0)),
                               leafBeside(place.cell + ivec3(0, 0, place.side.z)));
    return CellFacts(place, leaf.leafId, beside, leaf.lo, leaf.hi);
}

void main() {
    const uvec2 pixel = pixelAt(push.order, push.firstPlace + gl_WorkGroupID.x);
    if (!isInPicture(pixel)) {
        return;
    }
    const CameraRay view = centerRay(camera, pixel.x, pixel.y);
    const Ray ray = makeRay(lattice, view.origin, 0.0, view.dir, kFarthest);
    Trace trace = startTrace(ray);
    traverse(ray, false, trace);

    TriangleRecord triangle = noTriangle();
    CellFacts facts = noCellFacts();
    if (trace.hit.triangleId != kNoTriangle) {
        triangle = loadTriangle(trace.recordIndex);
        facts = loadCellFacts(cellPlace(ray, trace.hit.t, lattice.resolution));
    }
    setPixel(pixel, cellsPixel(push, camera, pixel, lattice, inspected(view, ray, trace), triangle, facts));
}
