/* Operators of cases: what is done with a run beside its measures, the word `with` of a case. An operator is one
 * descriptor, defined in its own file and named in the table of operators.c; nothing else knows of it. */
#ifndef BRC_COMMANDS_OPERATORS_H
#define BRC_COMMANDS_OPERATORS_H

#include "case_node.h"
#include "reproduce.h"

struct brc_operator {
    const char *name;
    bool one_run; /* cannot be taken over several seeds */
    /* In place of a run of the scene (a text, its name a path; results go to `folder`); NULL: the scene is run. */
    brc_status (*obtain)(brc_campaign *campaign, brc_outcome *outcome, const char *name, const char *text, size_t bytes,
                         const char *folder);
    /* What watches the run, created before it and freed after it; NULL: nothing does. */
    brc_status (*create)(brc_context *context, void **self);
    brc_observer (*observer)(void *self);
    bool stopped_too; /* the values of a run that failed or was stopped count too */
    brc_status (*values)(const brc_campaign *campaign, const void *self, brc_outcome *outcome);
    void (*release)(void *self);
    /* At the end of the run; NULL: nothing. */
    brc_status (*finished)(brc_context *context, brc_simulation *simulation, brc_outcome *outcome);
    /* After all runs of a campaign, into its folder where such runs were made; NULL: nothing. */
    brc_status (*figure)(brc_campaign *campaign);
};

/* All operators, brc_operator_measures first, NULL last. */
extern const brc_operator *const brc_operators[];
/* The operator that a node names; otherwise the problem is noted and brc_operator_measures returned. */
const brc_operator *brc_operator_of(const brc_case_reader *r, const brc_node *node);

extern const brc_operator brc_operator_measures;  /* nothing beside the measures */
extern const brc_operator brc_operator_vibration; /* modes against Rayleigh-Ritz of the scene's solid */
extern const brc_operator brc_operator_drift;     /* energy, momentum and angular momentum along the run */
extern const brc_operator brc_operator_build;     /* no run: seeds to domain file, timed */
extern const brc_operator brc_operator_isotropy;  /* no run: directions of bonds over n_seeds samples */
extern const brc_operator brc_operator_beams;     /* elastic tests of n_seeds samples of beams */
extern const brc_operator brc_operator_hondros;   /* stresses on the loaded diameter of a disc against Hondros */
extern const brc_operator brc_operator_virial;    /* virial stresses of pulled spheres against force over section */
extern const brc_operator brc_operator_pressing;  /* load over strain of the measure K along the run */
extern const brc_operator brc_operator_wave;      /* displacement of a bar's free end against d'Alembert's solution */
extern const brc_operator brc_operator_field;     /* stresses in a set against those of a disc or a plate with a hole */
extern const brc_operator brc_operator_told;      /* the error class of `check` before the run, against its error */
extern const brc_operator brc_operator_fragments; /* sizes of what a body broke into */
extern const brc_operator brc_operator_bounce;    /* touches, rebound and spin of a body thrown on the ground */
extern const brc_operator brc_operator_sides;     /* mean load of two sides along the run */

#endif
