/* The same C for several instruction sets: includes MODELER_BODY once for each of them.
 *
 * For x86-64 that is one version for AVX-512, one for AVX2 with FMA, and one for what the compiler
 * was told to build for; a version that this already covers is left out. Elsewhere there is one.
 * Define MODELER_PLAIN for C without vectors.
 *
 * While MODELER_BODY is read,
 *   MODELER_VERSION(name)  is the name with that of the version,
 *   MODELER_TARGET         stands before every function,
 *   MODELER_WIDTH          is how many numbers a vector has; 1: there are no vectors.
 * Afterwards MODELER_EACH_VERSION(X) is X(version), X(version)..., the best first, and
 * MODELER_BEST_VERSION the place in that list of the first that this processor can run.
 */
#ifndef MODELER_VERSIONS_H
#define MODELER_VERSIONS_H

#if defined(__GNUC__) && defined(__x86_64__) && !defined(MODELER_PLAIN)
#define MODELER_X86
#endif

#ifdef MODELER_SINGLE /* of modeler_real.h */
#define MODELER_WIDTH_OF(doubles, floats) floats
#else
#define MODELER_WIDTH_OF(doubles, floats) doubles
#endif

#if defined(MODELER_X86) && defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define MODELER_OWN_WIDTH MODELER_WIDTH_OF(8, 16)
#elif defined(MODELER_X86)
#define MODELER_V4
#if defined(__AVX2__) && defined(__FMA__)
#define MODELER_OWN_WIDTH MODELER_WIDTH_OF(4, 8)
#else
#define MODELER_OWN_WIDTH MODELER_WIDTH_OF(2, 4)
#define MODELER_V3
#endif
#elif defined(__GNUC__) && defined(__aarch64__) && !defined(MODELER_PLAIN)
#define MODELER_OWN_WIDTH MODELER_WIDTH_OF(2, 4)
#else
#define MODELER_OWN_WIDTH 1
#endif

#define MODELER_RUNS(set) __builtin_cpu_supports(set)
#define MODELER_RUNS_V3 (MODELER_RUNS("avx2") && MODELER_RUNS("fma"))
#define MODELER_RUNS_V4 (MODELER_RUNS("avx512f") && MODELER_RUNS("avx512dq") \
    && MODELER_RUNS("avx512vl") && MODELER_RUNS("avx512bw") && MODELER_RUNS("avx512cd") \
    && MODELER_RUNS_V3)

#if defined(MODELER_V3)
#define MODELER_EACH_VERSION(X) X(v4), X(v3), X(own)
#define MODELER_BEST_VERSION (MODELER_RUNS_V4 ? 0 : MODELER_RUNS_V3 ? 1 : 2)
#elif defined(MODELER_V4)
#define MODELER_EACH_VERSION(X) X(v4), X(own)
#define MODELER_BEST_VERSION (MODELER_RUNS_V4 ? 0 : 1)
#else
#define MODELER_EACH_VERSION(X) X(own)
#define MODELER_BEST_VERSION 0
#endif

#define MODELER_JOIN(a, b) MODELER_JOIN_(a, b)
#define MODELER_JOIN_(a, b) a##b

/* Lanes of two vectors, by constant places; `bits` is the vector of as many whole numbers. */
#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define MODELER_SHUFFLE(bits, a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define MODELER_SHUFFLE(bits, a, b, ...) __builtin_shuffle(a, b, (bits){__VA_ARGS__})
#endif

/* A store past the caches, to an aligned place; and what waits until all of them are done. */
#if defined(MODELER_X86) && defined(__clang__)
#define MODELER_STREAM(to, value) __builtin_nontemporal_store(value, to)
#elif defined(MODELER_X86)
#define MODELER_STREAM(to, value) \
    MODELER_JOIN(MODELER_STREAM_, MODELER_WIDTH)((modeler_real *)(to), value)
#ifdef MODELER_SINGLE
#define MODELER_STREAM_4 __builtin_ia32_movntps
#define MODELER_STREAM_8 __builtin_ia32_movntps256
#define MODELER_STREAM_16 __builtin_ia32_movntps512
#else
#define MODELER_STREAM_2 __builtin_ia32_movntpd
#define MODELER_STREAM_4 __builtin_ia32_movntpd256
#define MODELER_STREAM_8 __builtin_ia32_movntpd512
#endif
#else
#define MODELER_STREAM(to, value) (*(to) = (value))
#endif
#ifdef MODELER_X86
#define MODELER_FENCE __builtin_ia32_sfence()
#else
#define MODELER_FENCE (void)0
#endif

#endif

#ifdef MODELER_V4
#define MODELER_WIDTH MODELER_WIDTH_OF(8, 16)
#define MODELER_VERSION(name) name##_v4
#define MODELER_TARGET \
    __attribute__((target("avx512f,avx512dq,avx512vl,avx512bw,avx512cd,avx2,fma")))
#include MODELER_BODY
#undef MODELER_WIDTH
#undef MODELER_VERSION
#undef MODELER_TARGET
#endif

#ifdef MODELER_V3
#define MODELER_WIDTH MODELER_WIDTH_OF(4, 8)
#define MODELER_VERSION(name) name##_v3
#define MODELER_TARGET __attribute__((target("avx2,fma")))
#include MODELER_BODY
#undef MODELER_WIDTH
#undef MODELER_VERSION
#undef MODELER_TARGET
#endif

#define MODELER_WIDTH MODELER_OWN_WIDTH
#define MODELER_VERSION(name) name##_own
#define MODELER_TARGET
#include MODELER_BODY
#undef MODELER_WIDTH
#undef MODELER_VERSION
#undef MODELER_TARGET
