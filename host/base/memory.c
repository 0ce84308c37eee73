/* Aligned, zeroed, counted host memory. A 64-byte header in front of each block keeps its size, so that freeing and
 * resizing need no second argument. */
#include "memory.h"
#include "spill.h"
#include <malloc.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#define ALIGNMENT ((size_t)64)
/* Second word of a head: the block is not of the heap. */
#define ELSEWHERE ((size_t)1)
#define SPILLED ((size_t)2)
#define MAPPED ((size_t)3)
#define SPARSE ((size_t)4)
/* From here on a block has pages of its own, which are there once they are written. */
#define LEAST_MAPPED ((size_t)4 << 20)

/* Statistics of the process, not state that any computation reads. */
static atomic_int_least64_t held_bytes;
static atomic_int_least64_t peak_bytes;
static atomic_int_least64_t marked_bytes; /* most held since brc_memory_mark */

static void raise_to(atomic_int_least64_t *peak_of, int64_t now)
{
    int64_t peak = atomic_load(peak_of);
    while (now > peak && !atomic_compare_exchange_weak(peak_of, &peak, now)) {
    }
}

static void count(int64_t change)
{
    const int64_t now = atomic_fetch_add(&held_bytes, change) + change;
    raise_to(&peak_bytes, now);
    raise_to(&marked_bytes, now);
}

static size_t *size_of(void *block)
{
    return (size_t *)(void *)((char *)block - ALIGNMENT);
}

/* count * size rounded up to whole lines; 0 when it does not fit in half the address space. */
static size_t rounded_bytes(int64_t n, size_t size)
{
    size_t bytes;
    if (n < 0 || __builtin_mul_overflow((size_t)n, size, &bytes) || bytes > (size_t)INT64_MAX - 4 * ALIGNMENT) return 0;
    return bytes == 0 ? ALIGNMENT : (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

/* Zeroed memory with a head, `bytes` in all; *kind: of its head. NULL: none, for `reason`, which may stay as it is. */
static char *take(size_t bytes, size_t *kind, char reason[BRC_SPILL_REASON])
{
    *kind = bytes >= BRC_LEAST_SPILL && brc_spill_folder() ? SPILLED : bytes >= LEAST_MAPPED ? MAPPED : 0;
    if (*kind == SPILLED) return brc_spill_take(bytes, reason);
    if (*kind == MAPPED) {
        void *const memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        return memory == MAP_FAILED ? NULL : memory;
    }
    char *const memory = aligned_alloc(ALIGNMENT, bytes);
    if (memory) memset(memory, 0, bytes);
    return memory;
}

brc_status brc_memory_allocate(brc_context *context, void **out, int64_t n, size_t size, const char *what)
{
    *out = NULL;
    const size_t bytes = rounded_bytes(n, size);
    if (bytes == 0)
        return BRC_FAIL(context, BRC_NO_MEMORY, "%s: %lld items of %zu bytes are more than any machine addresses", what,
                        (long long)n, size);
    char reason[BRC_SPILL_REASON];
    size_t kind;
    char *const raw = take(bytes + ALIGNMENT, &kind, reason);
    if (!raw && kind == SPILLED)
        return BRC_FAIL(context, BRC_NO_MEMORY,
                        "%s: no memory for %lld items of %zu bytes (%.3g GB; %.3g GB are held) in %s (BRECCIA_SPILL): "
                        "%s; name a folder on a local disk with more room",
                        what, (long long)n, size, (double)bytes * 1e-9, (double)brc_memory_held() * 1e-9,
                        brc_spill_folder(), reason);
    if (!raw)
        return BRC_FAIL(
            context, BRC_NO_MEMORY,
            "%s: no memory for %lld items of %zu bytes (%.3g GB; %.3g GB are held); use fewer elements or a "
            "machine with more memory",
            what, (long long)n, size, (double)bytes * 1e-9, (double)brc_memory_held() * 1e-9);
    *out = raw + ALIGNMENT;
    size_of(*out)[0] = bytes;
    size_of(*out)[1] = kind;
    count((int64_t)bytes);
    return BRC_OK;
}

brc_status brc_memory_allocate_sparse(brc_context *context, void **out, int64_t n, size_t size, const char *what)
{
    const size_t bytes = rounded_bytes(n, size);
    void *const memory = bytes == 0 ? MAP_FAILED
                                    : mmap(NULL, bytes + ALIGNMENT, PROT_READ | PROT_WRITE,
                                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    *out = NULL;
    if (memory == MAP_FAILED)
        return BRC_FAIL(context, BRC_NO_MEMORY, "%s: no addresses for %lld items of %zu bytes; use fewer elements",
                        what, (long long)n, size);
    (void)madvise(memory, bytes + ALIGNMENT, MADV_NOHUGEPAGE); /* a large page would come whole */
    *out = (char *)memory + ALIGNMENT;
    size_of(*out)[0] = bytes;
    size_of(*out)[1] = SPARSE;
    return BRC_OK;
}

bool brc_memory_spill_sparse(void *block)
{
    size_t *const head = size_of(block);
    return head[1] == SPARSE && brc_spill_folder() && brc_spill_lay((char *)head, head[0] + ALIGNMENT);
}

int64_t brc_memory_sparse_resident(const void *block)
{
    enum { AT_ONCE = 4096 };
    unsigned char there[AT_ONCE];
    const uintptr_t first = (uintptr_t)block - ALIGNMENT;
    const int64_t page = sysconf(_SC_PAGESIZE),
                  n = (brc_memory_block_bytes(block) + (int64_t)ALIGNMENT + page - 1) / page;
    int64_t sum = 0;
    for (int64_t k = 0; k < n; k += AT_ONCE) {
        const int64_t some = n - k < AT_ONCE ? n - k : AT_ONCE;
        if (mincore((void *)(first + (uintptr_t)(k * page)), (size_t)(some * page), there) != 0) return sum;
        for (int64_t i = 0; i < some; ++i)
            sum += page * (there[i] & 1);
    }
    return sum;
}

brc_status brc_memory_resize(brc_context *context, void **block, int64_t n, size_t size, const char *what)
{
    void *fresh = NULL;
    BRC_TRY(brc_memory_allocate(context, &fresh, n, size, what));
    if (*block) {
        /* The bytes asked for, not the rounded ones: what lies beyond them in the new block must be zero. */
        const size_t wanted = (size_t)n * size;
        const size_t old = *size_of(*block);
        memcpy(fresh, *block, old < wanted ? old : wanted);
        brc_memory_free(*block);
    }
    *block = fresh;
    return BRC_OK;
}

int64_t brc_memory_block_bytes(const void *block)
{
    size_t bytes;
    memcpy(&bytes, (const char *)block - ALIGNMENT, sizeof bytes);
    return (int64_t)bytes;
}

void brc_memory_head(char head[BRC_MEMORY_HEAD], int64_t bytes)
{
    const size_t words[2] = {(size_t)bytes, ELSEWHERE};
    memset(head, 0, BRC_MEMORY_HEAD);
    memcpy(head, words, sizeof words);
}

void brc_memory_free(void *block)
{
    if (!block) return;
    size_t *const size = size_of(block);
    if (size[1] == ELSEWHERE) return;
    if (size[1] == SPARSE) {
        (void)munmap(size, *size + ALIGNMENT);
        return;
    }
    count(-(int64_t)*size);
    if (size[1] == SPILLED)
        brc_spill_give((char *)size, *size + ALIGNMENT);
    else if (size[1] == MAPPED)
        (void)munmap(size, *size + ALIGNMENT);
    else
        free(size);
}

void brc_memory_trim(void)
{
#ifdef __GLIBC__
    (void)malloc_trim(0);
#endif
}

void brc_memory_forget(void *at, int64_t bytes)
{
    const uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE);
    const uintptr_t first = ((uintptr_t)at + page - 1) / page * page,
                    end = ((uintptr_t)at + (uintptr_t)bytes) / page * page;
    const int advice = brc_spill_has(at) ? MADV_REMOVE : MADV_DONTNEED;
    if (first < end) (void)madvise((void *)first, (size_t)(end - first), advice); /* a wish */
}

void brc_memory_end_scope(void *variable)
{
    void *block;
    memcpy(&block, variable, sizeof block);
    brc_memory_free(block);
}

int64_t brc_memory_held(void)
{
    return atomic_load(&held_bytes);
}

int64_t brc_memory_peak(void)
{
    return atomic_load(&peak_bytes);
}

void brc_memory_mark(void)
{
    atomic_store(&marked_bytes, atomic_load(&held_bytes));
}

int64_t brc_memory_peak_since_mark(void)
{
    return atomic_load(&marked_bytes);
}

int64_t brc_memory_resident(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (int64_t)usage.ru_maxrss * 1024 : 0;
}
