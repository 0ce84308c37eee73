/* Frames of the recorder, with what lies beside them: cracks, strikers, pictures, and the indices of each. */
#include "recorder_internal.h"
#include "earlier_results.h"
#include "frames/striker_file.h"
#include "pictures/picture.h"
#include "../base/file.h"
#include "../base/memory.h"
#include <math.h>
#include <stdio.h>

brc_status brc_recorder_remove_frames(const brc_recorder *recorder, int64_t first)
{
    BRC_TRY(brc_earlier_remove_numbered(recorder->context, recorder->path[BRC_RECORD_FRAMES], first));
    return brc_earlier_remove_numbered(recorder->context, recorder->path[BRC_RECORD_PICTURES], first);
}

/* Viewers need rising times: physical time where some stage has it, else stages and their load factors; equal moments
 * (the end of a stage, the start of the next) are kept apart by the last digit. */
static double index_time(const brc_recorder *r, const brc_simulation *simulation)
{
    bool dynamic = false;
    for (int32_t s = 0; s < r->scene->n_stages; ++s)
        dynamic |= r->scene->stages[s].solver == BRC_SOLVER_DYNAMIC;
    const double time = dynamic ? brc_simulation_total_time(simulation)
                                : brc_simulation_stage(simulation) + brc_simulation_time(simulation);
    const double before = r->n_frames > 0 ? r->frame_time[r->n_frames - 1] : -INFINITY;
    return time > before ? time : nextafter(before, INFINITY);
}

/* Beside the frame just written. */
static brc_status write_cracks(brc_recorder *r)
{
    const bool surface = r->scene->output.crack_surface;
    char name[32];
    char *path = NULL;
    snprintf(name, sizeof name, "%06lld.cracks.vtu", (long long)r->n_frames - 1);
    BRC_TRY(brc_file_join(r->context, r->path[BRC_RECORD_FRAMES], name, &path));
    const brc_status status = brc_crack_records_frame(r->context, r->cracks, r->n_frames - 1, surface ? path : NULL);
    brc_memory_free(path);
    return status;
}

static brc_status write_strikers(brc_recorder *r)
{
    char name[40];
    char *path = NULL;
    snprintf(name, sizeof name, "%06lld.strikers.vtu", (long long)r->n_frames - 1);
    BRC_TRY(brc_file_join(r->context, r->path[BRC_RECORD_FRAMES], name, &path));
    const brc_status status = brc_striker_file_write(r->context, r->assembly, path);
    brc_memory_free(path);
    return status;
}

/* Beside the frame just written. */
static brc_status draw_frame(brc_recorder *r)
{
    char name[32];
    char *path = NULL;
    snprintf(name, sizeof name, "%06lld.png", (long long)r->n_frames - 1);
    BRC_TRY(brc_file_make_folder(r->context, r->path[BRC_RECORD_PICTURES]));
    BRC_TRY(brc_file_join(r->context, r->path[BRC_RECORD_PICTURES], name, &path));
    const brc_status status = brc_picture_write(r->context, r->assembly, path);
    brc_memory_free(path);
    return status;
}

static bool has_strikers(const brc_recorder *r)
{
    return brc_simulation_n_strikers(r->assembly->part[0]) > 0;
}

brc_status brc_recorder_write_series(const brc_recorder *r)
{
    const struct {
        bool wanted;
        const char *suffix;
        int path;
    } all[] = {{true, ".vtkhdf", BRC_RECORD_SERIES},
               {r->cracks && r->scene->output.crack_surface, ".cracks.vtu", BRC_RECORD_CRACK_SERIES},
               {has_strikers(r), ".strikers.vtu", BRC_RECORD_STRIKER_SERIES}};
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k)
        if (all[k].wanted)
            BRC_TRY(
                brc_frame_write_series(r->context, r->n_frames, r->frame_time, all[k].suffix, r->path[all[k].path]));
    return BRC_OK;
}

brc_status brc_recorder_add_frame(brc_recorder *r, brc_simulation *simulation)
{
    if (r->n_frames == 0) BRC_TRY(brc_file_make_folder(r->context, r->path[BRC_RECORD_FRAMES]));
    BRC_TRY(
        brc_memory_resize(r->context, (void **)&r->frame_time, r->n_frames + 1, sizeof *r->frame_time, "frame times"));
    BRC_TRY(brc_frames_write(r->frames, r->path[BRC_RECORD_FRAMES], r->n_frames));
    r->frame_time[r->n_frames] = index_time(r, simulation);
    ++r->n_frames;
    if (r->cracks) BRC_TRY(write_cracks(r));
    if (has_strikers(r)) BRC_TRY(write_strikers(r));
    if (r->scene->output.picture_frames) BRC_TRY(draw_frame(r));
    return brc_recorder_write_series(r);
}
