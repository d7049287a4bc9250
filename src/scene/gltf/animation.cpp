// SPDX-License-Identifier: MIT
#include "metamarch/scene/gltf/animation.h"

#include "metamarch/error/error.h"
#include "metamarch/scene/choice.h"
#include "metamarch/scene/gltf/accessor.h"
#include "metamarch/scene/gltf/element.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace metamarch {
namespace {

using Value = std::vector<double>;

enum class Interpolation { linear, step, cubicSpline };

Interpolation readInterpolation(const GltfElement& sampler) {
    const std::string name = sampler.text("interpolation", "LINEAR");
    if (name == "LINEAR") {
        return Interpolation::linear;
    }
    if (name == "STEP") {
        return Interpolation::step;
    }
    if (name == "CUBICSPLINE") {
        return Interpolation::cubicSpline;
    }
    sampler.refuse("interpolation '" + name + "' is none of LINEAR, STEP, CUBICSPLINE");
}

glm::dquat toQuaternion(const Value& xyzw) {
    return glm::normalize(glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]));
}

Value toValue(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

// The keyframes of one property of one node.
class Track {
  public:
    // `path` is glTF's name of the property: "translation", "rotation", "scale" or "weights".
    Track(const GltfDocument& document, const InputFile& file, const GltfElement& sampler,
          const std::string& path)
        : interpolation_(readInterpolation(sampler)), isRotation_(path == "rotation"),
          input_(document.model, file, sampler.label() + ": input", required(sampler, "input"),
                 TINYGLTF_TYPE_SCALAR),
          output_(document.model, file, sampler.label() + ": output", required(sampler, "output"),
                  path == "weights" ? TINYGLTF_TYPE_SCALAR
                  : isRotation_     ? TINYGLTF_TYPE_VEC4
                                    : TINYGLTF_TYPE_VEC3) {
        for (std::uint64_t i = 0; i < input_.count(); ++i) {
            times_.push_back(input_.scalar(i));
            if (!std::isfinite(times_[i]) || (i > 0 && times_[i] < times_[i - 1])) {
                sampler.refuse("the times decrease or are not finite at " + std::to_string(i));
            }
        }
        const std::uint64_t values = times_.size() * valuesOfKey();
        elementsOfValue_ = path == "weights" ? output_.count() / values : 1;
        components_ = path == "weights" ? 1 : isRotation_ ? 4 : 3;
        if (elementsOfValue_ == 0 || output_.count() != values * elementsOfValue_) {
            sampler.refuse(std::to_string(times_.size()) + " times, but " + std::to_string(output_.count()) +
                           " values");
        }
    }

    Value at(double seconds) const {
        const auto after = std::ranges::upper_bound(times_, seconds);
        if (after == times_.begin()) {
            return key(0);
        }
        const auto last = static_cast<std::size_t>(after - times_.begin()) - 1;
        if (after == times_.end() || interpolation_ == Interpolation::step) {
            return key(last);
        }
        const double duration = times_[last + 1] - times_[last];
        const double t = (seconds - times_[last]) / duration;
        if (interpolation_ == Interpolation::cubicSpline) {
            return spline(last, t, duration);
        }
        if (isRotation_) {
            return toValue(glm::slerp(toQuaternion(key(last)), toQuaternion(key(last + 1)), t));
        }
        return sum({{1.0 - t, key(last)}, {t, key(last + 1)}});
    }

  private:
    static int required(const GltfElement& sampler, const char* name) {
        const std::optional<int> accessor = sampler.integer(name);
        if (!accessor) {
            sampler.refuse(std::string("has no ") + name);
        }
        return *accessor;
    }

    // A keyframe of a cubic spline has three values: the in-tangent, the value and the out-tangent.
    std::uint64_t valuesOfKey() const { return interpolation_ == Interpolation::cubicSpline ? 3 : 1; }

    Value key(std::size_t i) const {
        return element(valuesOfKey() * i + (interpolation_ == Interpolation::cubicSpline ? 1 : 0));
    }

    Value element(std::uint64_t value) const {
        Value numbers;
        for (std::uint64_t i = 0; i < elementsOfValue_; ++i) {
            for (int c = 0; c < components_; ++c) {
                numbers.push_back(output_.component(value * elementsOfValue_ + i, c));
            }
        }
        return numbers;
    }

    // Evaluates the spline of glTF 2.0, appendix C.5.
    Value spline(std::size_t last, double t, double duration) const {
        const double t2 = t * t;
        const double t3 = t2 * t;
        return sum({{2.0 * t3 - 3.0 * t2 + 1.0, key(last)},
                    {duration * (t3 - 2.0 * t2 + t), element(3 * last + 2)},
                    {-2.0 * t3 + 3.0 * t2, key(last + 1)},
                    {duration * (t3 - t2), element(3 * last + 3)}});
    }

    static Value sum(const std::vector<std::pair<double, Value>>& terms) {
        Value total(terms.front().second.size(), 0.0);
        for (const auto& [weight, value] : terms) {
            for (std::size_t i = 0; i < total.size(); ++i) {
                total[i] += weight * value[i];
            }
        }
        return total;
    }

    Interpolation interpolation_;
    bool isRotation_;
    GltfAccessor input_;
    GltfAccessor output_;
    // Seconds, never decreasing. Of keyframes at the same time the first ends what comes before, and the last
    // begins what comes after: the value jumps.
    std::vector<double> times_;
    std::uint64_t elementsOfValue_ = 1;
    int components_ = 1;
};

std::vector<GltfElement> selectAnimations(const std::vector<GltfElement>& animations,
                                          const std::string& selection) {
    if (selection.empty()) {
        return animations;
    }
    std::vector<std::string> names;
    names.reserve(animations.size());
    for (const GltfElement& animation : animations) {
        names.push_back(animation.text("name"));
    }
    return {animations[chooseIndex("animation", names, selection)]};
}

// Returns null for a property that core glTF 2.0 cannot animate.
Value* property(tinygltf::Node& node, const std::string& path) {
    if (path == "translation") {
        return &node.translation;
    }
    if (path == "rotation") {
        return &node.rotation;
    }
    if (path == "scale") {
        return &node.scale;
    }
    return path == "weights" ? &node.weights : nullptr;
}

void play(GltfDocument& document, InputFile& file, const GltfElement& animation, double seconds) {
    const std::vector<GltfElement> samplers = animation.objects("samplers", "sampler");
    for (const GltfElement& channel : animation.objects("channels", "channel")) {
        const GltfElement target = channel.object("target");
        const std::optional<int> node = target.index("node", "node", document.model.nodes.size());
        const std::string path = target.text("path");
        Value* const value =
            node ? property(document.model.nodes[static_cast<std::size_t>(*node)], path) : nullptr;
        if (value == nullptr) {
            file.warn(channel.label() + ": path '" + path + "' is not animated");
            continue;
        }
        if (!document.model.nodes[static_cast<std::size_t>(*node)].matrix.empty()) {
            channel.refuse("node " + std::to_string(*node) + " has a matrix, which cannot be animated");
        }
        const std::optional<int> sampler = channel.index("sampler", "sampler", samplers.size());
        if (!sampler) {
            channel.refuse("has no sampler");
        }
        *value = Track(document, file, samplers[static_cast<std::size_t>(*sampler)], path).at(seconds);
    }
}

// Returns the time of the sampler's last key.
double lastKey(const GltfDocument& document, const InputFile& file, const GltfElement& sampler) {
    const std::optional<int> input = sampler.integer("input");
    if (!input) {
        return 0.0;
    }
    const GltfAccessor times(document.model, file, sampler.label() + ": input", *input, TINYGLTF_TYPE_SCALAR);
    const double last = times.count() == 0 ? 0.0 : times.scalar(times.count() - 1);
    return std::isfinite(last) ? last : 0.0;
}

} // namespace

void poseNodes(GltfDocument& document, InputFile& file, const std::string& animation, double seconds) {
    const std::vector<GltfElement> animations =
        GltfElement(file, "", &document.json).objects("animations", "animation");
    for (const GltfElement& selected : selectAnimations(animations, animation)) {
        play(document, file, selected, seconds);
    }
    if (animations.empty()) {
        file.warn("there is no animation, it looks the same at any time");
    }
}

std::vector<SceneAnimation> readAnimations(const GltfDocument& document, const InputFile& file) {
    std::vector<SceneAnimation> animations;
    for (const GltfElement& source :
         GltfElement(file, "", &document.json).objects("animations", "animation")) {
        SceneAnimation animation;
        try {
            animation.name = source.text("name");
            for (const GltfElement& sampler : source.objects("samplers", "sampler")) {
                animation.seconds = std::max(animation.seconds, lastKey(document, file, sampler));
            }
        } catch (const Error&) {
            // A broken animation is refused when it is played; a still of the scene does not need it.
        }
        animations.push_back(std::move(animation));
    }
    return animations;
}

} // namespace metamarch
