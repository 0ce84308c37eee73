/* OpenCL drivers are foreign code that the loader starts all at once, and some end or stop the process they are loaded
 * into: PoCL aborts where /sys is missing. So devices are listed by a fork of this process, which answers through a
 * pipe; a driver is loaded into the process itself only when one of its devices is opened.
 *
 * A fork holds one thread only, whatever OpenMP had. That is enough: the child runs the loader and the drivers, which
 * start threads of their own, and glibc sees to it that memory and the dynamic loader work there. */
#include "opencl_aside.h"
#include "../base/log.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- the child ---- */

/* A driver that calls exit() must not flush the parent's files a second time nor run its handlers. */
static void leave_at_once(int code, void *unused)
{
    (void)unused;
    _exit(code);
}

static void write_all(int pipe_end, const void *data, size_t bytes)
{
    for (const char *next = data; bytes > 0;) {
        const ssize_t written = write(pipe_end, next, bytes);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) _exit(1);
        next += written;
        bytes -= (size_t)written;
    }
}

static void be_the_child(brc_opencl_lister *lister, int pipe_end, brc_device_info *rows, int most)
{
    sigset_t none;
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);            /* nobody waits when the parent is gone */
    (void)setrlimit(RLIMIT_CORE, &(struct rlimit){0}); /* a crash here is foreseen */
    for (int number = 1; number < 32; ++number)
        (void)signal(number, SIG_DFL); /* the parent's handlers are about the parent */
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, NULL);
    (void)on_exit(leave_at_once, NULL);
    const int n = lister(rows, most);
    write_all(pipe_end, &n, sizeof n);
    write_all(pipe_end, rows, (size_t)n * sizeof *rows);
    _exit(0);
}

/* ---- the parent ---- */

/* All `bytes` bytes before the deadline [s of brc_clock_s]? */
static bool read_all(int pipe_end, void *data, size_t bytes, double deadline)
{
    for (char *next = data; bytes > 0;) {
        const double left = deadline - brc_clock_s();
        struct pollfd end = {.fd = pipe_end, .events = POLLIN};
        if (left <= 0) return false;
        const int ready = poll(&end, 1, (int)(left * 1000) + 1);
        if (ready < 0 && errno != EINTR) return false;
        if (ready <= 0) continue;
        const ssize_t got = read(pipe_end, next, bytes);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        next += got;
        bytes -= (size_t)got;
    }
    return true;
}

/* Its wait status; -1 where the program around this library takes the ends of all children for itself. */
static int end_of(pid_t child)
{
    int result = 0;
    pid_t waited;
    do
        waited = waitpid(child, &result, 0);
    while (waited < 0 && errno == EINTR);
    return waited == child ? result : -1;
}

void brc_opencl_aside(brc_opencl_lister *lister, double seconds, brc_device_info *rows, int most, int *n, char *why,
                      size_t bytes)
{
    int ends[2];
    *n = -1;
    if (pipe2(ends, O_CLOEXEC) != 0) {
        snprintf(why, bytes, "no pipe to a process that lists them: %s", strerror(errno));
        return;
    }
    const double deadline = brc_clock_s() + seconds;
    const pid_t child = fork();
    if (child == 0) be_the_child(lister, ends[1], rows, most);
    const int reason = errno;
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        snprintf(why, bytes, "no process to list them: %s", strerror(reason));
        return;
    }
    int found = -1;
    const bool whole = read_all(ends[0], &found, sizeof found, deadline) && found >= 0 && found <= most &&
                       read_all(ends[0], rows, (size_t)found * sizeof *rows, deadline);
    const bool late = !whole && brc_clock_s() >= deadline;
    close(ends[0]);
    (void)kill(child, SIGKILL); /* also where all is said: a driver's threads may hang at the end */
    const int result = end_of(child);
    if (whole)
        *n = found;
    else if (late)
        snprintf(why, bytes, "an OpenCL driver gave no answer in %.0f s while devices were listed", seconds);
    else if (result != -1 && WIFSIGNALED(result))
        snprintf(why, bytes, "an OpenCL driver ended with signal %d (%s) while devices were listed", WTERMSIG(result),
                 strsignal(WTERMSIG(result)));
    else if (result != -1)
        snprintf(why, bytes, "an OpenCL driver ended the program with exit code %d while devices were listed",
                 WEXITSTATUS(result));
    else
        snprintf(why, bytes, "an OpenCL driver ended the program while devices were listed");
}
