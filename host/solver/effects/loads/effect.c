/* Loads of stages as effects. Elements without bonds may be held where no load is asked for. */
#include "../effect.h"
#include "loads_internal.h"

static bool some_load(const brc_wants *w, brc_load_kind a, brc_load_kind b)
{
    for (int32_t i = 0; i < w->scene->n_stages; ++i)
        for (int32_t l = 0; l < w->scene->stages[i].n_loads; ++l) {
            const brc_load_kind kind = w->scene->stages[i].loads[l].kind;
            if (kind == a || kind == b) return true;
        }
    return false;
}
BRC_WANTED(faces, some_load(w, BRC_LOAD_FACE_DISPLACEMENT, BRC_LOAD_FACE_VELOCITY))
BRC_WANTED(tractions, some_load(w, BRC_LOAD_TRACTION, BRC_LOAD_PRESSURE))
BRC_WANTED(prescribed, some_load(w, BRC_LOAD_ELEMENT_DISPLACEMENT, BRC_LOAD_ELEMENT_VELOCITY))
BRC_WANTED(pushed, some_load(w, BRC_LOAD_ELEMENT_FORCE, BRC_LOAD_ELEMENT_FORCE))
BRC_WANTED(turned, some_load(w, BRC_LOAD_ELEMENT_ROTATION, BRC_LOAD_ELEMENT_ROTATION))

static brc_status enter(brc_simulation *s, const brc_occasion *now)
{
    const brc_status status = brc_loads_create(s, now->stage, s->loads);
    brc_memory_free(s->loads->held.left);
    s->loads->held.left = NULL;
    return status;
}
/* What they did is banked, and where faces were held is left to the next stage. */
static brc_status leave(brc_simulation *s)
{
    double work, *left;
    BRC_TRY(brc_loads_work(s, &work));
    s->loads->work_before += work;
    BRC_TRY(brc_held_faces_places(s, &left));
    brc_loads_free(s->loads);
    s->loads->held.left = left;
    return brc_set_face_loads(s, false);
}
static void release(brc_simulation *s)
{
    if (s->loads) {
        brc_memory_free(s->loads->held.left);
        brc_loads_free(s->loads);
    }
    brc_memory_free(s->loads);
    s->loads = NULL;
}
static brc_status create(brc_simulation *s)
{
    BRC_TRY(BRC_ALLOCATE(s->context, &s->loads, 1, "loads"));
    return brc_load_passes_make(s);
}
static brc_status constrain(brc_simulation *s, const brc_occasion *now)
{
    if (now->vector) BRC_TRY(brc_loads_zero_prescribed(s, now->vector));
    return now->rotations ? brc_loads_zero_turned(s, now->rotations) : BRC_OK;
}
BRC_CALLED(store, brc_loads_store(s, now->store))
/* A static stage leads what it prescribes from where it stands; modes move nothing. */
static brc_status place(brc_simulation *s, const brc_occasion *now)
{
    const bool moves = brc_current_stage(s)->solver == BRC_SOLVER_DYNAMIC;
    return moves ? brc_loads_prescribe(s, now->t) : brc_turns_prescribe(s, now->t);
}
BRC_CALLED(open_step, brc_turns_begin_step(s, now->t, now->until))
BRC_CALLED(close_step, brc_loads_impose_velocity(s, now->t))
BRC_CALLED(push, brc_pushes_apply(s, now->request))
static brc_status book(brc_simulation *s, const brc_occasion *now)
{
    BRC_TRY(brc_prescribed_book(s, now->request));
    return brc_turns_book(s, now->request);
}
static brc_status work(brc_simulation *s, const brc_occasion *now)
{
    double done = 0;
    if (brc_simulation_stage(s) >= 0) BRC_TRY(brc_loads_work(s, &done));
    now->ledger->work += done + s->loads->work_before;
    return BRC_OK;
}

static const brc_hooked hooked[] = {
    {.hook = BRC_HOOK_ENTER, .call = enter},      {.hook = BRC_HOOK_BEGIN, .plain = brc_loads_tell_jumps},
    {.hook = BRC_HOOK_LEAVE, .plain = leave},     {.hook = BRC_HOOK_STORE, .call = store},
    {.hook = BRC_HOOK_STRETCH, .call = store},    {.hook = BRC_HOOK_CONSTRAIN, .call = constrain},
    {.hook = BRC_HOOK_PLACE, .call = place},      {.hook = BRC_HOOK_OPEN_STEP, .call = open_step},
    {.hook = BRC_HOOK_CLOSE, .call = close_step}, {.hook = BRC_HOOK_FORCE, .order = BRC_FORCE_OF_LOADS, .call = push},
    {.hook = BRC_HOOK_BOOK, .call = book},        {.hook = BRC_HOOK_LEDGER, .call = work}};
const brc_effect brc_held_faces_effect = {
    .name = "prescribed faces",
    .in = faces,
    .fields =
        (const brc_field_table *const[]){&brc_held_element_fields, &brc_held_face_fields, &brc_held_load_fields, NULL}};
const brc_effect brc_tractions_effect = {
    .name = "tractions", .in = tractions, .fields = (const brc_field_table *const[]){&brc_traction_fields, NULL}};
const brc_effect brc_prescribed_effect = {.name = "imposed elements",
                                          .in = prescribed,
                                          .fields = (const brc_field_table *const[]){&brc_prescribed_fields, NULL}};
const brc_effect brc_pushes_effect = {
    .name = "forces on elements", .in = pushed, .fields = (const brc_field_table *const[]){&brc_push_fields, NULL}};
const brc_effect brc_turns_effect = {
    .name = "prescribed rotations", .in = turned, .fields = (const brc_field_table *const[]){&brc_turn_fields, NULL}};
/* Load kinds that ask for fields, and stages whose velocities they slow. */
static void ask(brc_wants *out, const int32_t *material)
{
    (void)material;
    out->face_loads = faces(out) || tractions(out);
}
const brc_effect brc_stage_loads_effect = {.ask = ask, .create = create, .free = release, BRC_HOOKED(hooked)};
