#include "report_view.h"
#include "report_discs.h"
#include "report_pack.h"
#include "report_rigid.h"
#include "report_skin.h"
#include "report_thin.h"
#include "../../base/memory.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Bytes of all shown frames before they are packed, from which follows how many are shown; and the most of them. */
enum { FRAMES_BYTES = 2600000, FRAMES_MOST = 60, FRAMES_LEAST = 2 };
/* Bytes of points and faces before they are packed: beyond them cracks of some cells are left out. */
enum { SURFACE_BYTES = 6000000 };
/* The colours of stress and speed end where all but this part of the values of all frames do. */
static const double OUTLIERS = 0.005;

/* One shown frame of the skin's points and elements. */
typedef struct moment {
    brc_report_frame head;    /* its moment; arrays freed */
    float *displacement;      /* [n_points][3] [m] */
    float *von_mises, *speed; /* [n_elements] */
    float *damage;            /* [n_elements]; NULL: nothing can break */
    int32_t *fragment;        /* [n_elements] */
} moment;

typedef struct view {
    brc_context *context;
    const char *folder;
    brc_report_frames *frames;
    brc_report_frame last;
    brc_report_skin skin;
    int64_t n_dropped;       /* faces of cracks that are left out */
    int64_t *place;          /* [n_points] in the frame being read */
    moment *at;              /* [frames.n] */
    float low[3], step;      /* of places: low + step * (0 .. 65535) [m] */
    float displacement_step; /* [m] */
    float most[2];           /* where the colours of stress and speed end */
} view;

static brc_status count_frames(view *v)
{
    for (bool more = true; more; v->frames->n_all += more)
        BRC_TRY(brc_report_frame_exists(v->context, v->folder, v->frames->n_all, &more));
    return BRC_OK;
}

/* Where there are too many faces: those of the first frame stay. */
static brc_status thin(view *v)
{
    brc_report_frame first;
    brc_status status = BRC_OK;
    BRC_TRY(BRC_ALLOCATE(v->context, &v->place, v->skin.n_points, "frames of the report"));
    if (brc_report_skin_bytes(&v->skin) <= SURFACE_BYTES) return BRC_OK;
    BRC_TRY(brc_report_frame_read(v->context, v->folder, 0, &first));
    if (first.n_elements == v->last.n_elements) { /* else it is told when the frames are read */
        brc_report_skin_places(&v->skin, &v->last, &first, v->place);
        status = brc_report_skin_births(v->context, &v->skin, &first, v->place, 0);
        if (status == BRC_OK) status = brc_report_skin_thin(v->context, &v->skin, SURFACE_BYTES, &v->n_dropped);
        for (int64_t f = 0; f < v->skin.n_faces; ++f)
            v->skin.birth[f] = -1;
    }
    brc_report_frame_free(&first);
    return status;
}

static brc_status choose_frames(view *v)
{
    const int64_t bytes = 6 * v->skin.n_points + (v->last.damage ? 5 : 2) * v->skin.n_elements + 1;
    int64_t n = FRAMES_BYTES / bytes;
    n = n > FRAMES_MOST ? FRAMES_MOST : n < FRAMES_LEAST ? FRAMES_LEAST : n;
    if (n > v->frames->n_all) n = v->frames->n_all;
    BRC_TRY(BRC_ALLOCATE(v->context, &v->frames->number, n, "frames of the report"));
    for (int64_t k = 0; k < n; ++k)
        v->frames->number[k] = n > 1 ? k * (v->frames->n_all - 1) / (n - 1) : v->frames->n_all - 1;
    v->frames->n = n;
    return BRC_OK;
}

static brc_status take(view *v, const brc_report_frame *f, moment *out)
{
    const brc_report_skin *s = &v->skin;
    const char *what = "frames of the report";
    BRC_TRY(BRC_ALLOCATE(v->context, &out->displacement, 3 * s->n_points, what));
    BRC_TRY(BRC_ALLOCATE(v->context, &out->von_mises, s->n_elements, what));
    BRC_TRY(BRC_ALLOCATE(v->context, &out->speed, s->n_elements, what));
    if (f->damage) {
        BRC_TRY(BRC_ALLOCATE(v->context, &out->damage, s->n_elements, what));
        BRC_TRY(BRC_ALLOCATE(v->context, &out->fragment, s->n_elements, what));
    }
    for (int64_t p = 0; p < s->n_points; ++p)
        memcpy(out->displacement + 3 * p, f->displacement + 3 * v->place[p], 3 * sizeof(float));
    for (int64_t k = 0; k < s->n_elements; ++k) {
        const int32_t e = s->element[k];
        out->von_mises[k] = f->von_mises[e];
        out->speed[k] = f->speed[e];
        if (!f->damage) continue;
        out->damage[k] = f->damage[e];
        out->fragment[k] = f->fragment[e];
    }
    return BRC_OK;
}

/* Points and births are looked for again only where bonds broke since the frame before. */
static brc_status read_moments(view *v)
{
    int64_t broken = -2;
    BRC_TRY(BRC_ALLOCATE(v->context, &v->at, v->frames->n, "frames of the report"));
    for (int64_t k = 0; k < v->frames->n; ++k) {
        brc_report_frame f;
        brc_status status = brc_report_frame_read(v->context, v->folder, v->frames->number[k], &f);
        if (status == BRC_OK && f.n_elements != v->last.n_elements)
            status = BRC_FAIL(v->context, BRC_BAD_INPUT, "%s/frames: frame %lld has %lld elements, the last one %lld",
                              v->folder, (long long)v->frames->number[k], (long long)f.n_elements,
                              (long long)v->last.n_elements);
        if (status == BRC_OK && f.n_broken != broken) {
            brc_report_skin_places(&v->skin, &v->last, &f, v->place);
            status = brc_report_skin_births(v->context, &v->skin, &f, v->place, (int32_t)k);
        }
        if (status == BRC_OK) status = take(v, &f, &v->at[k]);
        broken = f.n_broken;
        v->at[k].head = f;
        brc_report_frame_free(&f);
        BRC_TRY(status);
    }
    return BRC_OK;
}

static int by_value(const void *left, const void *right)
{
    const float a = *(const float *)left, b = *(const float *)right;
    return a < b ? -1 : a > b;
}

/* Below it lie all but a part of the values of all frames. */
static brc_status find_most(view *v, int field, float *out)
{
    float *all = NULL;
    int64_t n = 0;
    BRC_TRY(BRC_ALLOCATE(v->context, &all, v->frames->n * v->skin.n_elements, "values of the report"));
    for (int64_t k = 0; k < v->frames->n; ++k)
        for (int64_t e = 0; e < v->skin.n_elements; ++e) {
            const float value = field == 0 ? v->at[k].von_mises[e] : v->at[k].speed[e];
            if (isfinite(value)) all[n++] = value;
        }
    qsort(all, (size_t)n, sizeof *all, by_value);
    *out = n > 0 ? all[(int64_t)((double)(n - 1) * (1 - OUTLIERS))] : 0;
    if (n > 0 && !(*out > 0)) *out = all[n - 1];
    brc_memory_free(all);
    return BRC_OK;
}

static void find_steps(view *v)
{
    const brc_report_skin *s = &v->skin;
    float high[3] = {0}, extent = 0, most = 0;
    for (int64_t p = 0; p < s->n_points; ++p)
        for (int c = 0; c < 3; ++c) {
            const float x = v->last.point[3 * s->point[p] + c];
            if (p == 0 || x < v->low[c]) v->low[c] = x;
            if (p == 0 || x > high[c]) high[c] = x;
        }
    for (int c = 0; c < 3; ++c)
        extent = fmaxf(extent, high[c] - v->low[c]);
    for (int64_t k = 0; k < v->frames->n; ++k)
        for (int64_t p = 0; p < 3 * s->n_points; ++p) {
            const float u = fabsf(v->at[k].displacement[p]);
            if (isfinite(u)) most = fmaxf(most, u);
        }
    v->step = extent / 65535;
    v->displacement_step = most / 32767;
}

static int16_t quantised(float value, float step)
{
    const float steps = value / step;
    return isfinite(steps) ? (int16_t)(uint16_t)lrintf(fminf(fmaxf(steps, -32768), 65535)) : 0;
}

/* All x, then all y, then all z. */
static brc_status pack_vectors(const view *v, const float *vector, bool is_place, brc_report_pack *pack)
{
    const brc_report_skin *s = &v->skin;
    int16_t *one = NULL;
    BRC_TRY(BRC_ALLOCATE(v->context, &one, s->n_points, "points of the report"));
    for (int c = 0; c < 3; ++c) {
        for (int64_t p = 0; p < s->n_points; ++p)
            one[p] = is_place ? quantised(vector[3 * s->point[p] + c] - v->low[c], v->step)
                              : quantised(vector[3 * p + c], v->displacement_step);
        brc_report_pack_int16(pack, s->n_points, one);
    }
    brc_memory_free(one);
    return pack->status;
}

/* Faces in the order of their birth. */
static brc_status pack_faces(const view *v, brc_report_pack *pack)
{
    const brc_report_skin *s = &v->skin;
    int32_t *owner = NULL, *count = NULL, *corner = NULL;
    int64_t n = 0, n_corners = 0;
    const char *what = "faces of the report";
    brc_status status = BRC_OK;
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(v->context, &owner, s->n_faces, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(v->context, &count, s->n_faces, what));
    BRC_TRY_OR(cleanup, BRC_ALLOCATE(v->context, &corner, s->face_start[s->n_faces], what));
    for (int64_t k = 0; k < v->frames->n; ++k)
        for (int64_t f = 0; f < s->n_faces; ++f) {
            if (s->birth[f] != k) continue;
            const int64_t n_of_face = s->face_start[f + 1] - s->face_start[f];
            memcpy(corner + n_corners, s->face_corner + s->face_start[f], (size_t)n_of_face * sizeof *corner);
            n_corners += n_of_face;
            owner[n] = s->face_owner[f];
            count[n++] = (int32_t)n_of_face;
        }
    brc_report_pack_int32(pack, n, owner);
    brc_report_pack_int32(pack, n, count);
    brc_report_pack_int32(pack, n_corners, corner);
    status = pack->status;
cleanup:
    brc_memory_free(owner);
    brc_memory_free(count);
    brc_memory_free(corner);
    return status;
}

static int64_t count_born(const brc_report_skin *s, int64_t by, bool corners)
{
    int64_t n = 0;
    for (int64_t f = 0; f < s->n_faces; ++f)
        if (s->birth[f] >= 0 && s->birth[f] <= by) n += corners ? s->face_start[f + 1] - s->face_start[f] : 1;
    return n;
}

/* Points, their owners, radii of spheres, faces. */
static brc_status add_surface(const view *v, brc_text *page)
{
    const brc_report_skin *s = &v->skin;
    brc_report_pack pack = {.context = v->context};
    brc_status status = pack_vectors(v, v->last.point, true, &pack);
    brc_report_pack_int32(&pack, s->n_points, s->point_owner);
    if (status == BRC_OK) status = pack_faces(v, &pack);
    for (int64_t p = 0; v->last.radius && p < s->n_points; ++p)
        brc_report_pack_bytes(&pack, sizeof(float), &v->last.radius[s->point[p]]);
    if (status == BRC_OK) status = pack.status;
    if (status == BRC_OK) status = brc_html_array(page, "view-surface", pack.data, pack.n);
    brc_report_pack_free(&pack);
    return status;
}

static brc_status add_moment(const view *v, int64_t k, brc_text *page)
{
    const moment *m = &v->at[k];
    const int64_t n = v->skin.n_elements;
    char id[32];
    brc_report_pack pack = {.context = v->context};
    brc_status status = pack_vectors(v, m->displacement, false, &pack);
    brc_report_pack_levels(&pack, n, m->von_mises, 0, v->most[0]);
    brc_report_pack_levels(&pack, n, m->speed, 0, v->most[1]);
    if (m->damage) {
        brc_report_pack_levels(&pack, n, m->damage, 0, 1);
        for (int64_t e = 0; e < n; ++e) {
            const unsigned char two[2] = {(unsigned char)(m->fragment[e] >> 8), (unsigned char)m->fragment[e]};
            brc_report_pack_bytes(&pack, 2, two);
        }
    }
    snprintf(id, sizeof id, "view-%lld", (long long)k);
    if (status == BRC_OK) status = pack.status;
    if (status == BRC_OK) status = brc_html_array(page, id, pack.data, pack.n);
    brc_report_pack_free(&pack);
    return status;
}

static void add_frames(const view *v, brc_json *json)
{
    brc_json_begin_array(json, "frames");
    for (int64_t k = 0; k < v->frames->n; ++k) {
        const brc_report_frame *f = &v->at[k].head;
        brc_json_begin_object(json, NULL);
        brc_json_integer(json, "number", v->frames->number[k]);
        brc_json_number(json, "time", f->time);
        brc_json_number(json, "stage_time", f->stage_time);
        brc_json_integer(json, "stage", f->stage);
        if (f->n_broken >= 0) {
            brc_json_integer(json, "broken", f->n_broken);
            brc_json_integer(json, "fragments", f->n_fragments);
        }
        brc_json_integer(json, "faces", count_born(&v->skin, k, false));
        brc_json_end(json);
    }
    brc_json_end(json);
}

static void add_head(const view *v, brc_json *json)
{
    const brc_report_skin *s = &v->skin;
    brc_json_begin_object(json, "view");
    brc_json_integer(json, "n_all", v->frames->n_all);
    brc_json_integer(json, "n_points", s->n_points);
    brc_json_integer(json, "n_elements", s->n_elements);
    brc_json_integer(json, "n_all_elements", v->last.n_elements);
    brc_json_integer(json, "n_dropped", v->n_dropped);
    brc_json_integer(json, "n_faces", count_born(s, v->frames->n, false));
    brc_json_integer(json, "n_corners", count_born(s, v->frames->n, true));
    brc_json_boolean(json, "spheres", v->last.radius != NULL);
    brc_json_boolean(json, "fracture", v->last.damage != NULL);
    brc_json_begin_array(json, "low");
    for (int c = 0; c < 3; ++c)
        brc_json_number(json, NULL, v->low[c]);
    brc_json_end(json);
    brc_json_number(json, "step", v->step);
    brc_json_number(json, "displacement_step", v->displacement_step);
    brc_json_number(json, "most_stress", v->most[0]);
    brc_json_number(json, "most_speed", v->most[1]);
    add_frames(v, json);
}

static brc_status make(view *v, const brc_csv_read *cracks, brc_text *page, brc_json *json)
{
    BRC_TRY(brc_report_frame_read(v->context, v->folder, v->frames->n_all - 1, &v->last));
    BRC_TRY(brc_report_skin_make(v->context, &v->last, &v->skin));
    BRC_TRY(thin(v));
    BRC_TRY(choose_frames(v));
    BRC_TRY(read_moments(v));
    for (int field = 0; field < 2; ++field)
        BRC_TRY(find_most(v, field, &v->most[field]));
    find_steps(v);
    BRC_TRY(add_surface(v, page));
    for (int64_t k = 0; k < v->frames->n; ++k)
        BRC_TRY(add_moment(v, k, page));
    add_head(v, json);
    BRC_TRY(brc_report_discs(v->context, cracks, &v->last, &v->skin, page, json));
    BRC_TRY(brc_report_rigid(v->context, v->folder, v->frames->n, v->frames->number, page, json));
    brc_json_end(json);
    return BRC_OK;
}

brc_status brc_report_view(brc_context *context, const char *folder, const brc_csv_read *cracks, brc_text *page,
                           brc_json *json, brc_report_frames *frames)
{
    view v = {.context = context, .folder = folder, .frames = frames};
    *frames = (brc_report_frames){0};
    BRC_TRY(count_frames(&v));
    if (frames->n_all == 0) return BRC_OK;
    const brc_status status = make(&v, cracks, page, json);
    for (int64_t k = 0; v.at && k < frames->n; ++k) {
        moment *m = &v.at[k];
        void *const all[] = {m->displacement, m->von_mises, m->speed, m->damage, m->fragment};
        for (size_t i = 0; i < sizeof all / sizeof *all; ++i)
            brc_memory_free(all[i]);
    }
    brc_memory_free(v.at);
    brc_memory_free(v.place);
    brc_report_skin_free(&v.skin);
    brc_report_frame_free(&v.last);
    if (status != BRC_OK) brc_report_frames_free(frames);
    return status;
}

void brc_report_frames_free(brc_report_frames *frames)
{
    brc_memory_free(frames->number);
    *frames = (brc_report_frames){0};
}
