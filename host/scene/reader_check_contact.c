/* Checks of contact, of strikers, and of what watches them. */
#include "reader_internal.h"

/* Bodies may be brought to rest before anything moves; what has met or broken has no linear operator to solve with. */
static void check_rest_with_contact(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const brc_stage *moving = NULL;
    for (int k = 0; k < scene->n_stages; ++k) {
        const brc_stage *stage = &scene->stages[k];
        if (stage->solver == BRC_SOLVER_DYNAMIC)
            moving = moving ? moving : stage;
        else if (stage->most_events > 0)
            COMPLAIN(reader, &stage->most_events, stage,
                     "events: they know no contact, and what they break would meet; use a dynamic stage, or leave "
                     "contact out");
        else if (moving)
            COMPLAIN(reader, &stage->solver, stage,
                     "solver: static stages and modes know no contact, as surfaces that open and close have no linear "
                     "operator to solve with; expected before the first dynamic stage, "
                     "which is '%s'. Use `dynamic` with mass damping to find a rest, or leave contact out",
                     moving->name);
    }
}

/* Prescribed forces on free strikers. */
static void check_push(brc_reader *reader, const brc_striker *striker)
{
    const brc_scene *scene = reader->scene;
    bool moves = brc_reader_is_broken(reader, "stages");
    for (int k = 0; k < scene->n_stages; ++k)
        moves |= scene->stages[k].solver == BRC_SOLVER_DYNAMIC;
    for (int c = 0; c < 3; ++c)
        if (striker->held[c] && striker->force[c] != 0)
            COMPLAIN(reader, striker->force, striker,
                     "force: has no effect along %c, where `hold` lets the striker not move; expected 0 there",
                     'x' + c);
    if (!moves)
        COMPLAIN(reader, striker->force, striker,
                 "force: moves '%s' in dynamic stages, and the scene has none. At rest, load a wall of the body by "
                 "`traction` (force over area) in a static stage, or find the rest in a "
                 "dynamic stage with mass_damping",
                 striker->name);
}

/* Walls, strikers and what watches contact. */
void brc_reader_check_contact(brc_reader *reader)
{
    const brc_scene *scene = reader->scene;
    const bool known = scene->has_contact || brc_reader_is_broken(reader, "interactions");
    static const char *const CURE = "needs `interactions: {contact: {}}` at the top of the scene";
    for (int k = 0; k < scene->n_strikers; ++k) {
        const brc_striker *striker = &scene->strikers[k];
        if (!known) COMPLAIN(reader, NULL, striker, "striker '%s': touches nothing: it %s", striker->name, CURE);
        if (striker->is_plane && striker->motion == BRC_STRIKER_FREE)
            COMPLAIN(reader, &striker->motion, striker,
                     "motion: an endless plane has no mass; expected fixed or driven");
        if (striker->motion == BRC_STRIKER_FREE && striker->table.n > 0 && !striker->pushed)
            COMPLAIN(
                reader, &striker->table, striker,
                "table: is the factor of a prescribed force, and there is none; give `force`, or leave the table out");
        if (striker->pushed) check_push(reader, striker);
    }
    if (scene->has_contact) check_rest_with_contact(reader);
    for (int i = 0; i < scene->n_sensors && !known; ++i)
        if (scene->sensors[i].kind == BRC_SENSOR_CONTACT)
            COMPLAIN(reader, scene->sensors[i].term, &scene->sensors[i], "contact: this sensor %s", CURE);
}
