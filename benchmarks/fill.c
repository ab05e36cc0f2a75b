/* Fill memory with streaming stores, past the caches: the limit of whatever writes so many bytes. */
#include <stddef.h>
#include <stdint.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

void benchmark_fill(double *out, size_t length, double value)
{
    size_t i = 0;

    while (i < length && ((uintptr_t)(out + i) & 63))
        out[i++] = value;
#if defined(__AVX512F__)
    for (; i + 8 <= length; i += 8)
        _mm512_stream_pd(out + i, _mm512_set1_pd(value));
    _mm_sfence();
#elif defined(__AVX__)
    for (; i + 4 <= length; i += 4)
        _mm256_stream_pd(out + i, _mm256_set1_pd(value));
    _mm_sfence();
#elif defined(__x86_64__)
    for (; i + 2 <= length; i += 2)
        _mm_stream_pd(out + i, _mm_set1_pd(value));
    _mm_sfence();
#endif
    for (; i < length; i++)
        out[i] = value;
}
