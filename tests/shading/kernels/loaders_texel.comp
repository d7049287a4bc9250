// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define METAMARCH_TEXEL_BUFFERS 1
#include "shading/kernels/loaders.glsl"
