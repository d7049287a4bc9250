#include "metamarch/cli/rendering.h"

#include "metamarch/cli/device_settings.h"
#include "metamarch/cli/structure_report.h"

namespace metamarch::cli {

void describeDevice(const RenderJob& job, const render::SceneBuffers& scene, Rendering& rendering) {
    rendering.device = job.device->name();
    rendering.driver = job.device->report().driverInfo;
    rendering.traversal = job.traversal;
    if (job.traversal == marchThrough(TableMethod::rectilinear)) {
        rendering.rectilinear = reportRectilinear(scene.structures().rectilinearTable());
    }
}

void describeCpu(Rendering& rendering) {
    rendering.device = "cpu";
    rendering.driver = "metamarch";
    rendering.traversal = "kd_stack";
}

} // namespace metamarch::cli
