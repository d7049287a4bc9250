// SPDX-License-Identifier: MIT
// Macros through which the kernels read the scene. They use storage buffers or, if METAMARCH_TEXEL_BUFFERS is
// 1, texel buffers, which llvmpipe (Mesa 22.3.6) reads 1.4 times as fast. WORDS1, WORDS2 and WORDS4 declare
// an array whose entries have 1, 2 or 4 words; LOAD1, LOAD2 and LOAD4 read one entry. Only lib/triangles.glsl
// knows the kind of memory, too.
#ifndef METAMARCH_LIB_MEMORY_GLSL
#define METAMARCH_LIB_MEMORY_GLSL

#if METAMARCH_TEXEL_BUFFERS
#define WORDS1(name, number) layout(binding = number) uniform utextureBuffer name
#define WORDS2(name, number) layout(binding = number) uniform utextureBuffer name
#define WORDS4(name, number) layout(binding = number) uniform utextureBuffer name
#define LOAD1(name, i) texelFetch(name, int(i)).x
#define LOAD2(name, i) texelFetch(name, int(i)).xy
#define LOAD4(name, i) texelFetch(name, int(i))
#else
#define WORDS1(name, number)                                                                                 \
    layout(std430, binding = number) readonly buffer name##Buffer { uint name[]; }
#define WORDS2(name, number)                                                                                 \
    layout(std430, binding = number) readonly buffer name##Buffer { uvec2 name[]; }
#define WORDS4(name, number)                                                                                 \
    layout(std430, binding = number) readonly buffer name##Buffer { uvec4 name[]; }
#define LOAD1(name, i) name[i]
#define LOAD2(name, i) name[i]
#define LOAD4(name, i) name[i]
#endif

// Returns words[i & 3].
uint oneOf(const uvec4 words, const uint i) {
    const uint lower = (i & 1u) != 0u ? words.y : words.x;
    const uint upper = (i & 1u) != 0u ? words.w : words.z;
    return (i & 2u) != 0u ? upper : lower;
}
#endif
