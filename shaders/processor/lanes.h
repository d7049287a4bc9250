// SPDX-License-Identifier: MIT
// Vectors with a number for each of eight invocations, and the operations on them that `translate` writes.
//
// Every operation rounds as the shared headers do on the CPU, so a picture has the same bits. The vectors are
// those of GCC and Clang ("vector extensions"): a compiler splits them for processors with shorter ones. What
// the extensions lack is written for AVX2 and, lane by lane, for all others.
//
// Only sources that `translate` has written include this file. They are compiled several times, for
// processors of different age, so everything is in an anonymous namespace: no code of one may take the place
// of another's. For the same reason nothing of the standard library that has code is used.
#pragma once
#include "metamarch/processor/kernel_input.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace metamarch {
namespace {

// Begins every function here: a call would pass vectors through memory.
#define LANES inline __attribute__((always_inline))

using uint = std::uint32_t;
constexpr uint kLanes = KernelInput::kLanes;
using Floats = float __attribute__((vector_size(4 * kLanes)));
using Ints = int __attribute__((vector_size(4 * kLanes)));
using Uints = uint __attribute__((vector_size(4 * kLanes)));
using Mask = Ints; // a lane is 0 or -1

// Their copies are written out for the reason that `translate` gives for structs.
template <class X>
struct Vec2 {
    X x, y;
    LANES Vec2() {}
    LANES Vec2(const X& x_, const X& y_) : x(x_), y(y_) {}
    LANES Vec2(const Vec2& o) : x(o.x), y(o.y) {}
    LANES Vec2& operator=(const Vec2& o) {
        x = o.x;
        y = o.y;
        return *this;
    }
};
template <class X>
struct Vec3 {
    X x, y, z;
    LANES Vec3() {}
    LANES Vec3(const X& x_, const X& y_, const X& z_) : x(x_), y(y_), z(z_) {}
    LANES Vec3(const Vec3& o) : x(o.x), y(o.y), z(o.z) {}
    LANES Vec3& operator=(const Vec3& o) {
        x = o.x;
        y = o.y;
        z = o.z;
        return *this;
    }
};
template <class X>
struct Vec4 {
    X x, y, z, w;
    LANES Vec4() {}
    LANES Vec4(const X& x_, const X& y_, const X& z_, const X& w_) : x(x_), y(y_), z(z_), w(w_) {}
    LANES Vec4(const Vec4& o) : x(o.x), y(o.y), z(o.z), w(o.w) {}
    LANES Vec4& operator=(const Vec4& o) {
        x = o.x;
        y = o.y;
        z = o.z;
        w = o.w;
        return *this;
    }
};
template <class X, uint N>
struct Array {
    X values[N];
    LANES X& operator[](const uint i) { return values[i]; }
    LANES const X& operator[](const uint i) const { return values[i]; }
};

// What all invocations have in common, and the numbers of the eight that run.
struct Context {
    char* buffers[KernelInput::kBindings];
    const char* push;
    uint constants[KernelInput::kConstants];
    Vec3<uint> workgroup;
    Uints invocation; // in the workgroup
};

template <class T>
constexpr bool kIsVec = false;
template <class X>
constexpr bool kIsVec<Vec2<X>> = true;
template <class X>
constexpr bool kIsVec<Vec3<X>> = true;
template <class X>
constexpr bool kIsVec<Vec4<X>> = true;
template <class T>
concept Scalar = !kIsVec<T>; // a number, or one for each lane

template <class T>
using Plain = std::remove_cvref_t<T>;

// Applies `f` to each component.
template <class A, class F>
LANES auto eachOf(const Vec2<A>& a, const F& f) {
    return Vec2<decltype(f(a.x))>{f(a.x), f(a.y)};
}
template <class A, class F>
LANES auto eachOf(const Vec3<A>& a, const F& f) {
    return Vec3<decltype(f(a.x))>{f(a.x), f(a.y), f(a.z)};
}
template <class A, class F>
LANES auto eachOf(const Vec4<A>& a, const F& f) {
    return Vec4<decltype(f(a.x))>{f(a.x), f(a.y), f(a.z), f(a.w)};
}
template <class A, class B, class F>
LANES auto eachOf(const Vec2<A>& a, const Vec2<B>& b, const F& f) {
    return Vec2<decltype(f(a.x, b.x))>{f(a.x, b.x), f(a.y, b.y)};
}
template <class A, class B, class F>
LANES auto eachOf(const Vec3<A>& a, const Vec3<B>& b, const F& f) {
    return Vec3<decltype(f(a.x, b.x))>{f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)};
}
template <class A, class B, class F>
LANES auto eachOf(const Vec4<A>& a, const Vec4<B>& b, const F& f) {
    return Vec4<decltype(f(a.x, b.x))>{f(a.x, b.x), f(a.y, b.y), f(a.z, b.z), f(a.w, b.w)};
}

#define LANES_OPERATOR(op)                                                                                   \
    template <template <class> class V, class A, class B>                                                    \
        requires kIsVec<V<A>>                                                                                \
    LANES auto operator op(const V<A>& a, const V<B>& b) {                                                   \
        return eachOf(                                                                                       \
            a, b, [](const A& p, const B& q) __attribute__((always_inline)) { return p op q; });             \
    }                                                                                                        \
    template <template <class> class V, class A, Scalar B>                                                   \
        requires kIsVec<V<A>>                                                                                \
    LANES auto operator op(const V<A>& a, const B& b) {                                                      \
        return eachOf(                                                                                       \
            a, [&](const A& p) __attribute__((always_inline)) { return p op b; });                           \
    }
LANES_OPERATOR(+)
LANES_OPERATOR(-)
LANES_OPERATOR(*)
LANES_OPERATOR(/)
LANES_OPERATOR(<)
LANES_OPERATOR(>)
LANES_OPERATOR(<=)
LANES_OPERATOR(>=)
LANES_OPERATOR(==)
LANES_OPERATOR(!=)
LANES_OPERATOR(&)
LANES_OPERATOR(|)
LANES_OPERATOR(^)
LANES_OPERATOR(<<)
LANES_OPERATOR(>>)
#undef LANES_OPERATOR
template <template <class> class V, class A>
    requires kIsVec<V<A>>
LANES V<A> operator-(const V<A>& a) {
    return eachOf(
        a, [](const A& p) __attribute__((always_inline)) { return Plain<A>(-p); });
}

// The same for functions of one or two scalars.
#define LANES_EACH(function)                                                                                 \
    template <template <class> class V, class A>                                                             \
        requires kIsVec<V<A>>                                                                                \
    LANES auto function(const V<A>& a) {                                                                     \
        return eachOf(                                                                                       \
            a, [](const A& p) __attribute__((always_inline)) { return function(p); });                       \
    }
#define LANES_EACH_PAIR(function)                                                                            \
    template <template <class> class V, class A, class B>                                                    \
        requires kIsVec<V<A>>                                                                                \
    LANES auto function(const V<A>& a, const V<B>& b) {                                                      \
        return eachOf(                                                                                       \
            a, b, [](const A& p, const B& q) __attribute__((always_inline)) { return function(p, q); });     \
    }

// Masks

LANES Mask none() { return Mask{}; }
LANES bool any(const Mask m) {
#ifdef __AVX2__
    return _mm256_movemask_ps(reinterpret_cast<__m256>(m)) != 0;
#else
    int sum = 0;
    for (uint i = 0; i < kLanes; ++i) {
        sum |= m[i];
    }
    return sum != 0;
#endif
}
LANES Mask with(const Mask m, const Mask c) { return m & c; }
LANES Mask without(const Mask m, const Mask c) { return m & ~c; }
LANES Uints with(const Mask m, const Uints offset) { return reinterpret_cast<Uints>(m) & offset; }
LANES Mask logicalNot(const Mask c) { return ~c; }
LANES bool logicalNot(const bool c) { return !c; }

LANES Floats select(const Mask c, const Floats a, const Floats b) { return c < 0 ? a : b; }
LANES Uints select(const Mask c, const Uints a, const Uints b) { return c < 0 ? a : b; }
LANES Ints select(const Mask c, const Ints a, const Ints b) { return c < 0 ? a : b; }
template <template <class> class V, class X>
    requires kIsVec<V<X>>
LANES V<X> select(const Mask c, const V<X>& a, const V<X>& b) {
    return eachOf(
        a, b, [&](const X& p, const X& q) __attribute__((always_inline)) { return select(c, p, q); });
}
template <class X>
LANES Vec2<X> select(const Vec2<Mask>& c, const Vec2<X>& a, const Vec2<X>& b) {
    return {select(c.x, a.x, b.x), select(c.y, a.y, b.y)};
}
template <class X>
LANES Vec3<X> select(const Vec3<Mask>& c, const Vec3<X>& a, const Vec3<X>& b) {
    return {select(c.x, a.x, b.x), select(c.y, a.y, b.y), select(c.z, a.z, b.z)};
}
template <class X, uint N>
LANES Array<X, N> select(const Mask c, const Array<X, N>& a, const Array<X, N>& b) {
    Array<X, N> chosen;
    for (uint i = 0; i < N; ++i) {
        chosen[i] = select(c, a[i], b[i]);
    }
    return chosen;
}
template <class X>
LANES X select(const bool c, const X& a, const X& b) {
    return c ? a : b;
}
template <class X>
LANES auto anyOf(const Vec2<X>& v) {
    return v.x | v.y;
}
template <class X>
LANES auto anyOf(const Vec3<X>& v) {
    return v.x | v.y | v.z;
}
template <class X>
LANES auto allOf(const Vec2<X>& v) {
    return v.x & v.y;
}
template <class X>
LANES auto allOf(const Vec3<X>& v) {
    return v.x & v.y & v.z;
}

// Returns what Operation<T>::of makes of a scalar, or of each component of a Vec.
template <template <class> class Operation, class T, class Y>
LANES T as(const Y& y) {
    if constexpr (kIsVec<T>) {
        return eachOf(
            y, [](const auto& part)
                   __attribute__((always_inline)) { return Operation<decltype(T::x)>::of(part); });
    } else {
        return Operation<T>::of(y);
    }
}

// One number for all lanes

template <class T>
struct Splat;
template <>
struct Splat<Floats> {
    static LANES Floats of(const float x) { return Floats{x, x, x, x, x, x, x, x}; }
    static LANES Floats of(const Floats& x) { return x; }
};
template <>
struct Splat<uint> {
    static LANES uint of(const uint x) { return x; }
};
template <>
struct Splat<Uints> {
    static LANES Uints of(const uint x) { return Uints{x, x, x, x, x, x, x, x}; }
    static LANES Uints of(const Uints& x) { return x; }
};
template <>
struct Splat<Ints> {
    static LANES Ints of(const int x) { return Ints{x, x, x, x, x, x, x, x}; }
    static LANES Ints of(const bool x) { return of(x ? -1 : 0); }
    static LANES Ints of(const Ints& x) { return x; }
};
template <class T, class Y>
LANES T splat(const Y& y) {
    return as<Splat, T>(y);
}

// The same bits as another type. T says for how many lanes.

LANES float asFloat(const uint bits) { return __builtin_bit_cast(float, bits); }
template <class T>
struct Bits {
    template <class Y>
    static LANES T of(const Y& y) {
        return __builtin_bit_cast(T, y);
    }
};
template <class T, class Y>
LANES T bits(const Y& y) {
    return as<Bits, T>(y);
}

// Numbers as another type: from float towards 0.
template <class T>
struct Convert {
    template <class Y>
    static LANES T of(const Y& y) {
        if constexpr (std::is_arithmetic_v<T>) {
            return static_cast<T>(y);
#ifdef __AVX2__
        } else if constexpr (std::is_same_v<Y, Floats>) {
            // By the instruction, because C++ does not define conversions of numbers out of range, which
            // lanes that are not in the mask may have.
            constexpr float kHalf = 2147483648.0f;
            const Ints isLarge = std::is_same_v<T, Uints> ? y >= kHalf : Ints{};
            const Floats rest = isLarge < 0 ? y - kHalf : y;
            const auto whole = __builtin_bit_cast(Uints, _mm256_cvttps_epi32(reinterpret_cast<__m256>(rest)));
            return __builtin_bit_cast(T, whole ^ (reinterpret_cast<Uints>(isLarge) & 0x80000000u));
#endif
        } else {
            return __builtin_convertvector(y, T);
        }
    }
};
template <class T, class Y>
LANES T convert(const Y& y) {
    return as<Convert, T>(y);
}

// Functions of GLSL

LANES Floats absolute(const Floats x) { return bits<Floats>(bits<Uints>(x) & 0x7fffffffu); }
LANES float absolute(const float x) { return __builtin_fabsf(x); }
LANES float squareRoot(const float x) { return __builtin_sqrtf(x); }
LANES float floor(const float x) { return __builtin_floorf(x); }
#ifdef __AVX2__
LANES Floats squareRoot(const Floats x) {
    return reinterpret_cast<Floats>(_mm256_sqrt_ps(reinterpret_cast<__m256>(x)));
}
LANES Floats floor(const Floats x) {
    return reinterpret_cast<Floats>(_mm256_floor_ps(reinterpret_cast<__m256>(x)));
}
#else
LANES Floats squareRoot(const Floats x) {
    Floats root;
    for (uint i = 0; i < kLanes; ++i) {
        root[i] = __builtin_sqrtf(x[i]);
    }
    return root;
}
LANES Floats floor(const Floats x) {
    Floats lower;
    for (uint i = 0; i < kLanes; ++i) {
        lower[i] = __builtin_floorf(x[i]);
    }
    return lower;
}
#endif

// With NaN as GLM's min and max: the first argument.
template <Scalar A, Scalar B>
LANES auto smaller(const A& a, const B& b) {
    if constexpr (std::is_arithmetic_v<A> && std::is_arithmetic_v<B>) {
        return b < a ? b : a;
    } else {
        using T = std::conditional_t<std::is_arithmetic_v<A>, B, A>;
        const T p = splat<T>(a);
        const T q = splat<T>(b);
#ifdef __AVX2__
        if constexpr (std::is_same_v<T, Floats>) {
            return reinterpret_cast<Floats>(
                _mm256_min_ps(reinterpret_cast<__m256>(q), reinterpret_cast<__m256>(p)));
        }
#endif
        return T(q < p ? q : p);
    }
}
template <Scalar A, Scalar B>
LANES auto larger(const A& a, const B& b) {
    if constexpr (std::is_arithmetic_v<A> && std::is_arithmetic_v<B>) {
        return a < b ? b : a;
    } else {
        using T = std::conditional_t<std::is_arithmetic_v<A>, B, A>;
        const T p = splat<T>(a);
        const T q = splat<T>(b);
#ifdef __AVX2__
        if constexpr (std::is_same_v<T, Floats>) {
            return reinterpret_cast<Floats>(
                _mm256_max_ps(reinterpret_cast<__m256>(q), reinterpret_cast<__m256>(p)));
        }
#endif
        return T(p < q ? q : p);
    }
}
LANES_EACH(absolute)
LANES_EACH(squareRoot)
LANES_EACH(floor)
LANES_EACH_PAIR(smaller)
LANES_EACH_PAIR(larger)
#undef LANES_EACH
#undef LANES_EACH_PAIR
template <class A, class B, class C>
LANES auto clamped(const A& x, const B& least, const C& most) {
    return smaller(larger(x, least), most);
}

// A division by 0, which GLSL does not define, gives some number.
template <Scalar A, Scalar B>
LANES auto quotient(const A& a, const B& b) {
    return a / select(b == 0u, splat<B>(1u), b);
}
template <Scalar A, Scalar B>
LANES auto remainder(const A& a, const B& b) {
    return a % select(b == 0u, splat<B>(1u), b);
}
template <template <class> class V, class A, class B>
    requires kIsVec<V<A>>
LANES auto remainder(const V<A>& a, const B& b) {
    if constexpr (kIsVec<B>) {
        return eachOf(
            a, b,
            [](const auto& p, const auto& q) __attribute__((always_inline)) { return remainder(p, q); });
    } else {
        return eachOf(
            a, [&](const A& p) __attribute__((always_inline)) { return remainder(p, b); });
    }
}

template <class T>
LANES T bitReverse(T x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

// The number of the lowest bit that is set, -1 for 0.
LANES Ints findLsb(const Uints x) {
    // That bit alone is a power of two, so the exponent of the float is its number.
    const Floats power = convert<Floats>(x & (~x + 1u));
    const Ints exponent = bits<Ints>(bits<Uints>(power) >> 23) - 127;
    return select(x == 0u, splat<Ints>(-1), exponent);
}

// A half float in the low 16 bits. Denormal halves are normal floats.
LANES Floats halfToFloat(const Uints half) {
    const Uints sign = (half & 0x8000u) << 16;
    const Uints rest = half & 0x7fffu;
    // The exponent's bias is 15 in a half, 127 in a float: multiplying by 2^112 corrects it, and is exact.
    const Floats scaled = bits<Floats>(rest << 13) * asFloat(0x77800000u);
    const Floats value = select(rest >= 0x7c00u, bits<Floats>(rest << 13 | 0x7f800000u), scaled);
    return bits<Floats>(bits<Uints>(value) | sign);
}
LANES Vec2<Floats> unpackHalf2x16(const Uints packed) {
    return {halfToFloat(packed & 0xffffu), halfToFloat(packed >> 16)};
}

// Memory. Offsets are in bytes.

template <class T>
LANES T read(const char* const p) {
    T t;
    __builtin_memcpy(static_cast<void*>(&t), p, sizeof t);
    return t;
}
template <class T>
struct Gather {
    // Eight loads: the processor's own gather is slower, above all where it guards against "gather data
    // sampling" (Intel, 2023).
    static LANES T of(const char* const p, const Uints at) {
        const auto word = [&](const uint i) __attribute__((always_inline)) { return read<uint>(p + at[i]); };
        return bits<T>(Uints{word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7)});
    }
};
template <class X>
struct Gather<Vec2<X>> {
    static LANES Vec2<X> of(const char* const p, const Uints at) {
        return {Gather<X>::of(p, at), Gather<X>::of(p + 4, at)};
    }
};
template <class X>
struct Gather<Vec3<X>> {
    static LANES Vec3<X> of(const char* const p, const Uints at) {
        return {Gather<X>::of(p, at), Gather<X>::of(p + 4, at), Gather<X>::of(p + 8, at)};
    }
};
template <class X>
struct Gather<Vec4<X>> {
    static LANES Vec4<X> of(const char* const p, const Uints at) {
        // The four words of each lane, of which two are a vector of eight, and then a transposition.
        using Four = uint __attribute__((vector_size(16)));
        const auto pair = [&](const uint i) __attribute__((always_inline)) {
            const Four a = read<Four>(p + at[i]);
            const Four b = read<Four>(p + at[i + 4]);
            return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
        };
        const Uints r0 = pair(0);
        const Uints r1 = pair(1);
        const Uints r2 = pair(2);
        const Uints r3 = pair(3);
        const Uints t0 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
        const Uints t1 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
        const Uints t2 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
        const Uints t3 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
        return {bits<X>(__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13)),
                bits<X>(__builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15)),
                bits<X>(__builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13)),
                bits<X>(__builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15))};
    }
};
template <class T>
LANES T gather(const char* const p, const Uints at) {
    return Gather<T>::of(p, at);
}

template <Scalar X>
LANES void scatter(char* const p, const Uints at, const Mask m, const X& v) {
    for (uint i = 0; i < kLanes; ++i) {
        if (m[i] != 0) {
            const auto word = v[i];
            __builtin_memcpy(p + at[i], &word, sizeof word);
        }
    }
}
template <class X>
LANES void scatter(char* const p, const Uints at, const Mask m, const Vec2<X>& v) {
    scatter(p, at, m, v.x);
    scatter(p + 4, at, m, v.y);
}
template <class X>
LANES void scatter(char* const p, const Uints at, const Mask m, const Vec3<X>& v) {
    scatter(p, at, m, v.x);
    scatter(p + 4, at, m, v.y);
    scatter(p + 8, at, m, v.z);
}
template <class X>
LANES void scatter(char* const p, const Uints at, const Mask m, const Vec4<X>& v) {
    scatter(p, at, m, v.x);
    scatter(p + 4, at, m, v.y);
    scatter(p + 8, at, m, v.z);
    scatter(p + 12, at, m, v.w);
}

// The lanes add one after the other. Returns for each what was there before. No other thread may use the
// memory.
LANES Uints addInOrder(char* const p, const Mask m, const Uints v) {
    Uints before{};
    uint sum = read<uint>(p);
    for (uint i = 0; i < kLanes; ++i) {
        if (m[i] != 0) {
            before[i] = sum;
            sum += v[i];
        }
    }
    __builtin_memcpy(p, &sum, sizeof sum);
    return before;
}

// Executes all invocations of a workgroup.
LANES void runInLanes(const KernelInput& input, void (*const entry)(const Context& c, Mask m)) {
    Context c;
    for (uint i = 0; i < KernelInput::kBindings; ++i) {
        c.buffers[i] = input.buffers[i];
    }
    for (uint i = 0; i < KernelInput::kConstants; ++i) {
        c.constants[i] = input.constants[i];
    }
    c.push = input.push;
    c.workgroup = {input.workgroup, 0u, 0u};
    for (uint first = 0; first < input.invocations; first += kLanes) {
        c.invocation = Uints{0, 1, 2, 3, 4, 5, 6, 7} + first;
        entry(c, splat<Mask>(true));
    }
}

} // namespace
} // namespace metamarch
