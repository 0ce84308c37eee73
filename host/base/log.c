/* Log lines and the progress line, both on stderr. */
#include "log.h"
#include "context_internal.h"
#include "memory.h"
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define TERMINAL_INTERVAL_S 0.2
#define LINE_INTERVAL_S 10.0
#define LINE_INTERVAL_PART 0.05
#define LINE_LEAST_S 1.0 /* a task of a second is not worth a line that stays */

struct brc_progress {
    brc_context *context;
    int64_t total;
    int64_t done;
    double rate_per_unit;
    double started_s;
    double shown_s;     /* clock when the line was last shown */
    int64_t shown_done; /* units done then */
    bool terminal;
    bool told;      /* was it shown at all? */
    bool on_screen; /* a line without newline stands on the terminal */
    char what[64];
    char unit_name[32];
    char rate_name[32];
};

static double read_clock(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double brc_clock_s(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

double brc_processor_s(void)
{
    return read_clock(CLOCK_PROCESS_CPUTIME_ID);
}

void brc_log_set_level(brc_context *context, brc_log_level level)
{
    context->level = level;
}

brc_log_level brc_log_get_level(const brc_context *context)
{
    return context->level;
}

void brc_log_set_sink(brc_context *context, brc_log_sink sink, void *self)
{
    context->sink = sink;
    context->sink_self = self;
}

void brc_log_follow(brc_context *context, const brc_context *other)
{
    context->level = other->level;
    brc_log_set_sink(context, other->sink, other->sink_self);
}

static void clear_line(brc_progress *progress)
{
    if (!progress || !progress->on_screen) return;
    fputs("\r\033[K", stderr);
    progress->on_screen = false;
}

void brc_log(brc_context *context, brc_log_level level, const char *format, ...)
{
    static const char *const prefix[] = {"error: ", "warning: ", "", "debug: "};
    if (!context || level > context->level) return;
    if (context->sink) {
        char line[2048];
        va_list words;
        va_start(words, format);
        vsnprintf(line, sizeof line, format, words);
        va_end(words);
        context->sink(context->sink_self, level, line);
        return;
    }
    clear_line(context->progress);
    fputs(prefix[level], stderr);
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

/* "12.3 s", "4 min 05 s", "2 h 07 min". */
static void format_duration(char *text, size_t size, double seconds)
{
    if (seconds < 60.0) {
        snprintf(text, size, "%.1f s", seconds);
        return;
    }
    const long long whole = (long long)(seconds + 0.5);
    if (whole < 3600)
        snprintf(text, size, "%lld min %02lld s", whole / 60, whole % 60);
    else
        snprintf(text, size, "%lld h %02lld min", whole / 3600, whole % 3600 / 60);
}

/* 45.2 M, 980, 3.4 G: three digits and a letter. */
static void format_rate(char *text, size_t size, double rate)
{
    static const char *const letter[] = {"", " k", " M", " G", " T"};
    int k = 0;
    while (rate >= 1000.0 && k < 4) {
        rate /= 1000.0;
        ++k;
    }
    snprintf(text, size, "%.3g%s", rate, letter[k]);
}

static void show(brc_progress *progress, bool last)
{
    const double now = brc_clock_s();
    const double elapsed = now - progress->started_s;
    progress->shown_s = now;
    progress->shown_done = progress->done;
    progress->told = true;
    if (!progress->context || progress->context->level < BRC_LOG_INFO || progress->context->sink) return;

    char line[400], spent[32], rate[32], left[32] = "";
    format_duration(spent, sizeof spent, elapsed);
    const double done = (double)progress->done;
    const double per_unit = progress->rate_per_unit > 0.0 ? progress->rate_per_unit : 1.0;
    format_rate(rate, sizeof rate, elapsed > 0.0 ? done * per_unit / elapsed : 0.0);
    const bool known = progress->total > 0;
    if (!last && known && progress->done > 0)
        format_duration(left, sizeof left, elapsed * ((double)progress->total - done) / done);
    char part[128] = "";
    if (known)
        snprintf(part, sizeof part, "%.0f %% (%lld of %lld %s)", 100.0 * done / (double)progress->total,
                 (long long)progress->done, (long long)progress->total, progress->unit_name);
    else
        snprintf(part, sizeof part, "%lld %s", (long long)progress->done, progress->unit_name);
    snprintf(line, sizeof line, "%s: %s, %s %s, %s%s%s", progress->what, part, rate, progress->rate_name, spent,
             *left ? ", left " : "", left);
    clear_line(progress);
    if (progress->terminal && !last) {
        fputs(line, stderr);
        progress->on_screen = true;
        fflush(stderr);
    } else {
        fprintf(stderr, "%s\n", line);
    }
}

brc_status brc_progress_create(brc_context *context, brc_progress **out, const char *what, int64_t total,
                               const char *unit_name, double rate_per_unit, const char *rate_name)
{
    *out = NULL;
    brc_progress *progress;
    BRC_TRY(BRC_ALLOCATE(context, &progress, 1, "progress line"));
    progress->context = context;
    progress->total = total;
    progress->rate_per_unit = rate_per_unit;
    progress->terminal = isatty(STDERR_FILENO) == 1;
    snprintf(progress->what, sizeof progress->what, "%s", what);
    snprintf(progress->unit_name, sizeof progress->unit_name, "%s", unit_name);
    if (rate_name && rate_per_unit > 0.0)
        snprintf(progress->rate_name, sizeof progress->rate_name, "%s", rate_name);
    else
        snprintf(progress->rate_name, sizeof progress->rate_name, "%.29s/s", unit_name);
    progress->started_s = progress->shown_s = brc_clock_s();
    if (context) context->progress = progress;
    *out = progress;
    return BRC_OK;
}

void brc_progress_update(brc_progress *progress, int64_t done)
{
    if (!progress) return;
    progress->done = done;
    const double waited_s = brc_clock_s() - progress->shown_s;
    const double part = (double)(done - progress->shown_done);
    const bool is_part = progress->total > 0 && part >= LINE_INTERVAL_PART * (double)progress->total;
    if (progress->terminal ? waited_s >= TERMINAL_INTERVAL_S
                           : waited_s >= LINE_INTERVAL_S || (waited_s >= LINE_LEAST_S && (is_part || !progress->told)))
        show(progress, false);
}

void brc_progress_finish(brc_progress **progress)
{
    if (!progress || !*progress) return;
    if (brc_clock_s() - (*progress)->started_s >= LINE_LEAST_S) show(*progress, true);
    clear_line(*progress);
    brc_context *context = (*progress)->context;
    if (context && context->progress == *progress) context->progress = NULL;
    brc_memory_free(*progress);
    *progress = NULL;
}
