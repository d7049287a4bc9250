// SPDX-License-Identifier: MIT
// Functions whose lanes part and meet in every way that GLSL has, and operations at their borders. The test
// compares a kernel that is translated from this file with the same file compiled as C++.
#ifndef METAMARCH_TESTS_CONTROL_FLOW_H
#define METAMARCH_TESTS_CONTROL_FLOW_H
#include "shared/interop.h"

#ifdef __cplusplus
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#endif

SHARED_BEGIN
#ifdef __cplusplus
using glm::bitfieldReverse, glm::findLSB, glm::unpackHalf2x16;
#endif

struct Part {
    uint count;
    vec3 sum;
};

struct Whole {
    Part part;
    uint last;
};

// Comes from push constants or a buffer, the same for all lanes, until they choose.
struct Setting {
    uint factor;
    uint added;
    float scale;
};

SHARED_FN uint early(const uint x) {
    if ((x & 1u) != 0u) {
        return x * 3u;
    }
    if ((x & 2u) != 0u) {
        if ((x & 4u) != 0u) {
            return 7u;
        }
        return x + 11u;
    }
    return x >> 1u;
}

// Lanes leave at different turns, some by a break, some by a return, and some turns end early.
SHARED_FN uint turns(const uint x) {
    uint sum = 0u;
    for (uint i = 0u; i < (x & 15u); ++i) {
        if ((i + x) % 3u == 0u) {
            continue;
        }
        if (i == 9u) {
            break;
        }
        if (sum > 40u) {
            return sum * 1000u + i;
        }
        sum += i + (x & 3u);
    }
    return sum;
}

// A value that a lane leaves the inner loop with must not change while others go on.
SHARED_FN uint nested(const uint x) {
    uint result = 0u;
    uint kept = 5u;
    for (uint i = 0u; i < 4u; ++i) {
        uint inner = x;
        do {
            const uint next = inner / 2u + i;
            kept = next ^ (i << 8u);
            inner = next;
            if (inner % 64u == 6u) {
                break;
            }
        } while (inner > 8u + (x & 7u));
        result = result * 31u + kept + inner;
        if ((result & 16u) != 0u && i == 2u) {
            continue;
        }
        result += 1u;
    }
    return result;
}

// A lane returns out of two loops while others go on in both.
SHARED_FN uint outOfTwo(const uint x) {
    uint sum = x;
    for (uint i = 0u; i < 5u; ++i) {
        for (uint j = 0u; j <= (x & 3u); ++j) {
            sum = sum * 5u + i * 2u + j;
            if (sum % 23u == 4u) {
                return sum ^ (i << 16u);
            }
            if (sum % 7u == 1u) {
                break;
            }
        }
        sum += 3u;
    }
    return sum;
}

SHARED_FN bool isOdd(const uint x, const uint depth) {
    bool isIt = (x & 1u) != 0u;
    while (depth > 100u) {
        return !isIt;
    }
    return isIt;
}

SHARED_FN Whole changed(const Whole before, const uint x) {
    Whole whole = before;
    if (isOdd(x, x) || (x % 5u == 0u && isOdd(x / 2u, 0u))) {
        whole.part.count += x;
        whole.part.sum.y = float(x) * 0.5f;
    } else if (x > 20u && !(x > 40u)) {
        whole.part.sum = vec3(1.0f, 2.0f, 3.0f) * float(whole.last);
    }
    whole.last = x;
    return whole;
}

SHARED_FN uint structs(const uint x) {
    Whole whole;
    whole.part.count = 1u;
    whole.part.sum = vec3(0.25f);
    whole.last = 2u;
    for (uint i = 0u; i < 3u; ++i) {
        whole = changed(whole, x + i * 7u);
    }
    const vec3 sum = whole.part.sum;
    return whole.part.count + floatBitsToUint(sum.x) + floatBitsToUint(sum.y) * 3u +
           floatBitsToUint(sum.z) * 5u + whole.last;
}

SHARED_FN Setting chosen(const Setting a, const Setting b, const uint x) {
    Setting setting = a;
    if ((x & 8u) != 0u) {
        setting = b;
    } else if (x % 11u == 0u) {
        setting.factor = x;
    }
    return setting;
}

SHARED_FN uint settings(const Setting a, const Setting b, const uint x) {
    const Setting setting = chosen(a, b, x);
    uint sum = uint(float(x & 0xfffu) * setting.scale) * setting.factor + setting.added;
    if (a.factor < b.factor) { // the same for all lanes
        sum += 17u;
    }
    for (uint i = 0u; i < b.added; ++i) { // the same number of turns
        sum = sum * 3u + (x >> i);
    }
    return sum;
}

// Numbers at the borders. Conversions stay within what both languages define.
SHARED_FN uint numbers(const uint x) {
    const float f = uintBitsToFloat(x * 0x9e3779b9u);
    uint bits = floatBitsToUint(abs(f)) ^ floatBitsToUint(float(x * 0x9e3779b9u));
    bits ^= floatBitsToUint(sqrt(abs(f)));
    bits ^= bitfieldReverse(x) + uint(findLSB(x)) * 3u + uint(findLSB(x << 20u));
    bits ^= floatBitsToUint(min(f, 1.0f)) + floatBitsToUint(max(0.5f, f)) * 3u;
    bits ^= floatBitsToUint(clamp(f, -2.0f, 3.0f));
    if (abs(f) < 4.0e9f) {
        bits += uint(abs(f)) + floatBitsToUint(floor(f)) * 7u;
    }
    if (abs(f) < 2.0e9f) {
        bits += uint(int(f)) * 11u + floatBitsToUint(float(int(f)));
    }
    bits ^= floatBitsToUint(float(int(x) - 50)) + (x * 0x9e3779b9u) % (x + 3u) + (0xfffffff0u / (x + 1u));
    return bits;
}

SHARED_FN uint halves(const uint x) {
    const vec2 pair = unpackHalf2x16(x | ((x ^ 0x8000u) << 16u));
    return floatBitsToUint(pair.x) ^ (floatBitsToUint(pair.y) * 3u);
}

SHARED_END
#endif
