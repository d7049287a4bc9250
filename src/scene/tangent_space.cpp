// SPDX-License-Identifier: MIT
#include "metamarch/scene/tangent_space.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace metamarch {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// MikkTSpace's test for zero, in single precision like the rest of the algorithm.
bool isNotZero(float x) { return std::abs(x) > std::numeric_limits<float>::min(); }

glm::vec3 normalized(const glm::vec3& v) {
    const float length = std::sqrt(glm::dot(v, v));
    return isNotZero(length) ? v * (1.0f / length) : v;
}

// Projects v into the plane perpendicular to the normal and normalises it.
glm::vec3 inPlane(const glm::vec3& v, const glm::vec3& normal) {
    return normalized(v - normal * glm::dot(normal, v));
}

struct Face {
    glm::vec3 alongS{0.0f};        // unit vector along which s grows
    bool turnsLikeTexture = false; // whether the corners are counter-clockwise in texture space too
    bool joinsAny = true;          // has no area in texture space; joins whichever group reaches it first
    // The face across the edge from corner i to i + 1.
    std::array<std::uint32_t, 3> neighbor = {kNone, kNone, kNone};
    std::array<bool, 3> grouped = {false, false, false}; // whether corner i is in a group
};

struct Edge {
    std::uint32_t lo, hi; // vertices
    std::uint32_t face;
    std::uint32_t corner; // where the edge starts
    bool reversed;        // the edge starts at hi

    bool operator<(const Edge& other) const {
        return std::tie(lo, hi, face, corner) < std::tie(other.lo, other.hi, other.face, other.corner);
    }
};

class TangentSpace {
  public:
    explicit TangentSpace(std::span<const TangentCorner> corners)
        : corners_(corners), tangents_(corners.size(), glm::vec4(1.0f, 0.0f, 0.0f, 1.0f)) {}

    std::vector<glm::vec4> compute() {
        weld();
        for (std::uint32_t i = 0; i < corners_.size() / 3; ++i) {
            faces_.push_back(makeFace(i));
        }
        linkNeighbors();
        for (std::uint32_t face = 0; face < faces_.size(); ++face) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                if (!isDegenerate(face) && !faces_[face].joinsAny && !faces_[face].grouped[corner]) {
                    evaluate(collectGroup(face, corner));
                }
            }
        }
        finishDegenerates();
        return std::move(tangents_);
    }

  private:
    using Key = std::array<std::uint32_t, 8>;

    struct KeyHash {
        std::size_t operator()(const Key& key) const {
            std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a, one word at a time
            for (const std::uint32_t word : key) {
                hash = (hash ^ word) * 0x100000001b3u;
            }
            return static_cast<std::size_t>(hash ^ (hash >> 32));
        }
    };

    // One corner of a face in a group.
    struct Member {
        std::uint32_t face;
        std::uint32_t corner;
    };

    std::uint32_t vertex(std::uint32_t face, std::uint32_t corner) const {
        return vertices_[3 * face + corner];
    }
    const TangentCorner& at(std::uint32_t face, std::uint32_t corner) const {
        return corners_[3 * face + corner];
    }

    // Gives equal corners the same vertex; -0 equals 0.
    void weld() {
        std::unordered_map<Key, std::uint32_t, KeyHash> known;
        for (const TangentCorner& c : corners_) {
            const std::array<float, 8> numbers = {c.position.x, c.position.y, c.position.z, c.normal.x,
                                                  c.normal.y,   c.normal.z,   c.texCoord.x, c.texCoord.y};
            Key key;
            std::ranges::transform(numbers, key.begin(),
                                   [](float number) { return std::bit_cast<std::uint32_t>(number + 0.0f); });
            vertices_.push_back(
                known.try_emplace(key, static_cast<std::uint32_t>(known.size())).first->second);
        }
    }

    bool isDegenerate(std::uint32_t face) const {
        const glm::vec3 &a = at(face, 0).position, &b = at(face, 1).position, &c = at(face, 2).position;
        return a == b || b == c || a == c;
    }

    Face makeFace(std::uint32_t index) const {
        Face face;
        const TangentCorner &a = at(index, 0), &b = at(index, 1), &c = at(index, 2);
        const glm::vec2 t1 = b.texCoord - a.texCoord;
        const glm::vec2 t2 = c.texCoord - a.texCoord;
        const glm::vec3 d1 = b.position - a.position;
        const glm::vec3 d2 = c.position - a.position;
        const float area = t1.x * t2.y - t1.y * t2.x; // twice the signed area
        face.turnsLikeTexture = area > 0.0f;
        if (!isNotZero(area)) {
            return face;
        }
        const glm::vec3 s = d1 * t2.y - d2 * t1.y;
        const glm::vec3 t = d2 * t1.x - d1 * t2.x;
        const float lengthS = std::sqrt(glm::dot(s, s));
        const float lengthT = std::sqrt(glm::dot(t, t));
        if (isNotZero(lengthS)) {
            face.alongS = s * ((face.turnsLikeTexture ? 1.0f : -1.0f) / lengthS);
        }
        face.joinsAny = !isNotZero(lengthS / std::abs(area)) || !isNotZero(lengthT / std::abs(area));
        return face;
    }

    // Two faces are neighbours if they traverse a shared edge in opposite directions. If three or more faces
    // share an edge, each gets at most one neighbour.
    void linkNeighbors() {
        std::vector<Edge> edges;
        for (std::uint32_t face = 0; face < faces_.size(); ++face) {
            for (std::uint32_t corner = 0; corner < 3 && !isDegenerate(face); ++corner) {
                const std::uint32_t from = vertex(face, corner);
                const std::uint32_t to = vertex(face, (corner + 1) % 3);
                edges.push_back({std::min(from, to), std::max(from, to), face, corner, from > to});
            }
        }
        std::ranges::sort(edges, std::less<>());
        for (std::size_t begin = 0; begin < edges.size();) {
            std::size_t end = begin;
            while (end < edges.size() && edges[end].lo == edges[begin].lo &&
                   edges[end].hi == edges[begin].hi) {
                ++end;
            }
            linkEdges(std::span(edges).subspan(begin, end - begin));
            begin = end;
        }
    }

    // Goes through the edges in order. Each is linked to the first later edge of the opposite direction that
    // is still free.
    void linkEdges(std::span<const Edge> edges) {
        std::array<std::vector<Edge>, 2> free; // indexed by reversed; oldest first
        std::array<std::size_t, 2> next = {0, 0};
        for (const Edge& edge : edges) {
            const std::size_t other = edge.reversed ? 0 : 1;
            if (next[other] < free[other].size()) {
                const Edge& partner = free[other][next[other]++];
                faces_[edge.face].neighbor[edge.corner] = partner.face;
                faces_[partner.face].neighbor[partner.corner] = edge.face;
            } else {
                free[1 - other].push_back(edge);
            }
        }
    }

    // Returns the faces around a corner that can be reached across edges, have the same orientation as the
    // first face and are in no group yet. The order of the faces matters in one place only: which group gets
    // a face with joinsAny.
    std::vector<Member> collectGroup(std::uint32_t firstFace, std::uint32_t firstCorner) {
        const std::uint32_t center = vertex(firstFace, firstCorner);
        const bool turns = faces_[firstFace].turnsLikeTexture;
        std::vector<Member> group;
        std::vector<std::uint32_t> pending = {firstFace};
        while (!pending.empty()) {
            const std::uint32_t index = pending.back();
            pending.pop_back();
            if (index == kNone) {
                continue;
            }
            Face& face = faces_[index];
            std::uint32_t corner = 0;
            while (corner < 2 && vertex(index, corner) != center) {
                ++corner;
            }
            if (face.grouped[corner]) {
                continue;
            }
            if (face.joinsAny && face.grouped == std::array<bool, 3>{false, false, false}) {
                face.turnsLikeTexture = turns;
            }
            if (face.turnsLikeTexture != turns) {
                continue;
            }
            face.grouped[corner] = true;
            group.push_back({index, corner});
            pending.push_back(face.neighbor[(corner + 2) % 3]);
            pending.push_back(face.neighbor[corner]);
        }
        return group;
    }

    // Averages the faces' tangents in the plane of the normal, weighted by the faces' angles in that plane.
    void evaluate(std::vector<Member> group) {
        std::ranges::sort(group, {}, &Member::face);
        glm::vec3 sum(0.0f);
        for (const auto [index, corner] : group) {
            const Face& face = faces_[index];
            if (face.joinsAny) {
                continue;
            }
            const TangentCorner& c = at(index, corner);
            const glm::vec3 before = inPlane(at(index, (corner + 2) % 3).position - c.position, c.normal);
            const glm::vec3 after = inPlane(at(index, (corner + 1) % 3).position - c.position, c.normal);
            const double cosine = std::clamp(glm::dot(before, after), -1.0f, 1.0f);
            sum += inPlane(face.alongS, c.normal) * static_cast<float>(std::acos(cosine));
        }
        glm::vec3 tangent = normalized(sum);
        if (!(glm::dot(tangent, tangent) > 0.0f)) { // zero or NaN
            tangent = glm::vec3(1.0f, 0.0f, 0.0f);
        }
        for (const auto [index, corner] : group) {
            tangents_[3 * index + corner] = glm::vec4(tangent, faces_[index].turnsLikeTexture ? 1.0f : -1.0f);
        }
    }

    // Degenerate triangles take the tangents of a non-degenerate triangle at the same vertex.
    void finishDegenerates() {
        // Vertex to its first corner in a non-degenerate triangle.
        std::unordered_map<std::uint32_t, std::uint32_t> sound;
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            if (!isDegenerate(i / 3)) {
                sound.try_emplace(vertices_[i], i);
            }
        }
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            const auto found = isDegenerate(i / 3) ? sound.find(vertices_[i]) : sound.end();
            if (found != sound.end()) {
                tangents_[i] = tangents_[found->second];
            }
        }
    }

    std::span<const TangentCorner> corners_;
    std::vector<glm::vec4> tangents_;
    std::vector<std::uint32_t> vertices_; // indexed by corner
    std::vector<Face> faces_;
};

} // namespace

std::vector<glm::vec4> mikkTangents(std::span<const TangentCorner> corners) {
    return TangentSpace(corners).compute();
}

} // namespace metamarch
