/* CUDA enough to run emitted kernels on a processor: one block at a time, threads of C++. */
#include <barrier>
#include <cmath>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#define __device__
#define __global__
#define __constant__
#define __forceinline__ inline
#define __shared__ static

struct place {
    unsigned x;
};
static thread_local place threadIdx;
static place blockIdx, blockDim, gridDim;
static std::unique_ptr<std::barrier<>> together;

static inline void __syncthreads()
{
    together->arrive_and_wait();
}

template <class Kernel> static void launch(unsigned blocks, unsigned threads, Kernel kernel)
{
    gridDim.x = blocks;
    blockDim.x = threads;
    for (blockIdx.x = 0; blockIdx.x < blocks; blockIdx.x++) {
        std::vector<std::thread> running;

        together = std::make_unique<std::barrier<>>(threads);
        for (unsigned i = 0; i < threads; i++)
            running.emplace_back([i, kernel] {
                threadIdx.x = i;
                kernel();
            });
        for (auto &thread : running)
            thread.join();
    }
}
