/* One file, mapped once. Blocks have sizes of eight classes a doubling; those that were given back are taken again, and
 * their pages were cut out of the file meanwhile, so that they are zero. Room on the disk is set aside before a block
 * is handed out: a full disk is then a sentence, not a signal. */
#include "spill.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/statvfs.h>
#include <unistd.h>

#define ROOM ((size_t)1 << 42) /* of addresses, and of the file, which is empty at first */
enum { CLASSES = 8 * 48 };

/* Places that were given back. */
typedef struct stack {
    size_t n, room, *place;
} stack;

static struct {
    pthread_once_t once;
    pthread_mutex_t lock;
    char *memory; /* NULL: none, for `reason` */
    int file;
    size_t used;
    stack given[CLASSES];
    char reason[BRC_SPILL_REASON];
} spill = {.once = PTHREAD_ONCE_INIT, .lock = PTHREAD_MUTEX_INITIALIZER, .file = -1};

static const char *chosen;

void brc_spill_into(const char *folder)
{
    chosen = folder;
}

const char *brc_spill_folder(void)
{
    if (chosen) return chosen;
    const char *const folder = getenv("BRECCIA_SPILL");
    return folder && *folder ? folder : NULL;
}

int brc_spill_file(void)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/breccia-XXXXXX", brc_spill_folder());
    if (length >= (int)sizeof path) errno = ENAMETOOLONG;
    const int file = length < (int)sizeof path ? mkostemp(path, O_CLOEXEC) : -1;
    if (file >= 0) unlink(path);
    return file;
}

static void hold(void)
{
    pthread_mutex_lock(&spill.lock);
}

static void let_go(void)
{
    pthread_mutex_unlock(&spill.lock);
}

/* In a child: what it writes is its own from here; pages of the parent's file stay where they are. */
static void begin_again(void)
{
    pthread_mutex_unlock(&spill.lock);
    if (!spill.memory) return;
    if (spill.used > 0)
        (void)mmap(spill.memory, spill.used, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE | MAP_FIXED,
                   spill.file, 0);
    close(spill.file);
    for (int k = 0; k < CLASSES; ++k)
        spill.given[k].n = 0;
    spill.memory = NULL;
    spill.file = -1;
    spill.used = 0;
    spill.once = (pthread_once_t)PTHREAD_ONCE_INIT;
}

static void watch_forks(void)
{
    (void)pthread_atfork(hold, let_go, begin_again);
}

static void begin(void)
{
    void *memory = MAP_FAILED;
    static pthread_once_t watched = PTHREAD_ONCE_INIT;
    pthread_once(&watched, watch_forks);
    spill.file = brc_spill_file();
    if (spill.file >= 0 && ftruncate(spill.file, (off_t)ROOM) == 0)
        memory = mmap(NULL, ROOM, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, spill.file, 0);
    if (memory == MAP_FAILED)
        snprintf(spill.reason, sizeof spill.reason, "no file for it: %s", strerror(errno));
    else
        spill.memory = memory;
}

/* The size that a block gets, at whole pages, and its class. */
static size_t class_of(size_t bytes, int *k)
{
    int doubling = 0;
    while (bytes >> (doubling + 1) > 0)
        ++doubling;
    const size_t step = (size_t)1 << (doubling - 3), n = (bytes + step - 1) / step; /* 8 .. 16 */
    *k = 8 * doubling + (int)n - 8;
    return n * step;
}

/* SIZE_MAX: the addresses are used up. */
static size_t find_place(size_t size, int k)
{
    stack *const given = &spill.given[k];
    if (given->n > 0) return given->place[--given->n];
    if (size > ROOM - spill.used) return SIZE_MAX;
    spill.used += size;
    return spill.used - size;
}

static void keep_place(size_t place, int k)
{
    stack *const given = &spill.given[k];
    if (given->n == given->room) {
        const size_t room = given->room > 0 ? 2 * given->room : 64;
        size_t *const more = realloc(given->place, room * sizeof *more);
        if (!more) return; /* its addresses are not taken again */
        given->place = more;
        given->room = room;
    }
    given->place[given->n++] = place;
}

static void return_place(size_t place, size_t size, int k)
{
    if (fallocate(spill.file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, (off_t)place, (off_t)size) != 0) return;
    pthread_mutex_lock(&spill.lock);
    keep_place(place, k);
    pthread_mutex_unlock(&spill.lock);
}

char *brc_spill_take(size_t bytes, char reason[BRC_SPILL_REASON])
{
    int k;
    const size_t size = class_of(bytes, &k);
    pthread_once(&spill.once, begin);
    if (!spill.memory) {
        memcpy(reason, spill.reason, sizeof spill.reason);
        return NULL;
    }
    if ((double)size > brc_spill_room()) {
        snprintf(reason, BRC_SPILL_REASON, "%.3g GB are free there", 1e-9 * brc_spill_room());
        return NULL;
    }
    pthread_mutex_lock(&spill.lock);
    const size_t place = k < CLASSES ? find_place(size, k) : SIZE_MAX;
    pthread_mutex_unlock(&spill.lock);
    if (place == SIZE_MAX) {
        snprintf(reason, BRC_SPILL_REASON, "no addresses are left");
        return NULL;
    }
    if (fallocate(spill.file, 0, (off_t)place, (off_t)size) != 0) {
        snprintf(reason, BRC_SPILL_REASON, "no room can be set aside: %s", strerror(errno));
        return_place(place, size, k);
        return NULL;
    }
    return spill.memory + place;
}

void brc_spill_give(char *memory, size_t bytes)
{
    int k;
    const size_t size = class_of(bytes, &k);
    if (!brc_spill_has(memory)) return; /* the parent's */
    return_place((size_t)(memory - spill.memory), size, k);
}

bool brc_spill_lay(char *at, size_t bytes)
{
    static const char nothing[4096];
    char reason[BRC_SPILL_REASON];
    char *const place = brc_spill_take(bytes, reason);
    if (!place) return false;
    for (size_t k = 0; k < bytes; k += sizeof nothing) {
        const size_t some = bytes - k < sizeof nothing ? bytes - k : sizeof nothing;
        if (memcmp(at + k, nothing, some) != 0) memcpy(place + k, at + k, some);
    }
    if (mmap(at, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED | MAP_NORESERVE, spill.file,
             (off_t)(place - spill.memory)) != MAP_FAILED)
        return true;
    brc_spill_give(place, bytes);
    return false;
}

bool brc_spill_has(const void *at)
{
    const char *const place = at;
    return spill.memory && place >= spill.memory && place < spill.memory + ROOM;
}

double brc_spill_room(void)
{
    struct statvfs about;
    const char *const folder = brc_spill_folder();
    return folder && statvfs(folder, &about) == 0 ? (double)about.f_bavail * (double)about.f_frsize : 0.0;
}
