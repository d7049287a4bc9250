// SPDX-License-Identifier: MIT
#include "metamarch/bench/embree_peer.h"

#include "metamarch/bench/hit_check.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <embree3/rtcore.h>
#include <stdexcept>

namespace metamarch::bench {
namespace {

constexpr std::size_t kPacket = 16;

double secondsSince(const std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

RTCGeometry makeGeometry(const RTCDevice device, const Scene& scene) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                std::max<std::size_t>(scene.positions.size(), 1)));
    std::copy(scene.positions.begin(), scene.positions.end(), vertices);
    auto* const indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                std::max<std::size_t>(scene.triangles.size(), 1)));
    std::copy(scene.triangles.begin(), scene.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    return geometry;
}

void traceSingly(const RTCScene scene, const std::span<const RayQuery> rays, const HitQuery query,
                 std::vector<RayResult>& results) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayQuery& ray = rays[i];
        RTCRayHit hit{};
        hit.ray = {ray.origin.x, ray.origin.y, ray.origin.z, ray.tMin, ray.dir.x, ray.dir.y,
                   ray.dir.z,    0.0f,         ray.tMax,     ~0u,      0u,        0u};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        hit.hit.primID = kNoTriangle;
        if (query == HitQuery::closest) {
            rtcIntersect1(scene, &context, &hit);
        } else {
            rtcOccluded1(scene, &context, &hit.ray);
            hit.hit.primID = hit.ray.tfar < 0.0f ? 0u : kNoTriangle; // Embree reports a hit by -inf
        }
        results[i] = {hit.ray.tfar, hit.hit.primID, 0, 0};
    }
}

void traceInPackets(const RTCScene scene, const std::span<const RayQuery> rays, const HitQuery query,
                    std::vector<RayResult>& results) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, rays.size() - first);
        alignas(64) std::array<int, kPacket> valid{};
        alignas(64) RTCRayHit16 hit{};
        for (std::size_t k = 0; k < count; ++k) {
            const RayQuery& ray = rays[first + k];
            valid[k] = -1;
            hit.ray.org_x[k] = ray.origin.x;
            hit.ray.org_y[k] = ray.origin.y;
            hit.ray.org_z[k] = ray.origin.z;
            hit.ray.tnear[k] = ray.tMin;
            hit.ray.dir_x[k] = ray.dir.x;
            hit.ray.dir_y[k] = ray.dir.y;
            hit.ray.dir_z[k] = ray.dir.z;
            hit.ray.tfar[k] = ray.tMax;
            hit.ray.mask[k] = ~0u;
            hit.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            hit.hit.primID[k] = kNoTriangle;
        }
        if (query == HitQuery::closest) {
            rtcIntersect16(valid.data(), scene, &context, &hit);
        } else {
            rtcOccluded16(valid.data(), scene, &context, &hit.ray);
        }
        for (std::size_t k = 0; k < count; ++k) {
            const bool occluded = query == HitQuery::any && hit.ray.tfar[k] < 0.0f;
            results[first + k] = {hit.ray.tfar[k], occluded ? 0u : hit.hit.primID[k], 0, 0};
        }
    }
}

bool countBytes(void* const sum, const ssize_t bytes, bool /*after*/) {
    *static_cast<std::atomic<std::int64_t>*>(sum) += bytes;
    return true;
}

} // namespace

struct EmbreePeer::Impl {
    BenchScene& scene;
    std::atomic<std::int64_t> bytes = 0;
    RTCDevice device = nullptr;
    RTCScene rtcScene = nullptr;
    double buildSeconds = 0.0;
};

EmbreePeer::EmbreePeer(BenchScene& scene) : impl(new Impl{scene}) {
    impl->device = rtcNewDevice(nullptr);
    if (impl->device == nullptr) {
        throw std::runtime_error("Embree does not start");
    }
    rtcSetDeviceMemoryMonitorFunction(impl->device, countBytes, &impl->bytes);
    const auto start = std::chrono::steady_clock::now();
    impl->rtcScene = rtcNewScene(impl->device);
    if (!scene.scene.triangles.empty()) {
        const RTCGeometry geometry = makeGeometry(impl->device, scene.scene);
        rtcAttachGeometry(impl->rtcScene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(impl->rtcScene);
    impl->buildSeconds = secondsSince(start);
}

EmbreePeer::~EmbreePeer() {
    rtcReleaseScene(impl->rtcScene);
    rtcReleaseDevice(impl->device);
}

std::vector<Row> EmbreePeer::bench(const JudgedRays& rays, const Protocol& protocol) const {
    const bool closest = rays.set.query == HitQuery::closest;
    const HitTolerance tolerance{kTolerance * impl->scene.structure.lattice.extent, 1.0};
    std::vector<RayResult> results(rays.set.rays.size());
    std::vector<Row> rows;
    const auto add = [&](const char* name, const auto& trace) {
        const auto run = [&] {
            const auto start = std::chrono::steady_clock::now();
            trace(impl->rtcScene, rays.set.rays, rays.set.query, results);
            return secondsSince(start);
        };
        run();
        Row row = describeRow(impl->scene, rays, name, "cpu", "one thread", results);
        row.differingHits =
            countDifferent(rays.set.rays, results, rays.judged.results, rays.set.query, tolerance);
        row.visitsPerRay.reset(); // Embree does not count
        row.testsPerRay.reset();
        row.buildSeconds = impl->buildSeconds;
        row.bytes = static_cast<std::uint64_t>(std::max<std::int64_t>(impl->bytes, 0));
        const Summary speed = measureMraysPerSecond(protocol, row.rayCount, run);
        row.mraysPerSecond = speed.median;
        row.spread = speed.spread;
        rows.push_back(row);
    };
    add(closest ? "rtcIntersect1" : "rtcOccluded1", traceSingly);
    add(closest ? "rtcIntersect16" : "rtcOccluded16", traceInPackets);
    return rows;
}

} // namespace metamarch::bench
