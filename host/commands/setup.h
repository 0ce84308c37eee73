/* From a scene to simulations that are ready to run: its parts, a domain, a device and a simulation for each, and the
 * assembly of all. */
#ifndef BRC_COMMANDS_SETUP_H
#define BRC_COMMANDS_SETUP_H

#include "../solver/run/assembly.h"

typedef struct brc_setup {
    brc_split *split;
    int32_t n;                   /* parts; 0: not split yet */
    brc_domain **built;          /* [n] by this setup; NULL entries where it was given */
    const brc_domain **domain;   /* [n] used */
    brc_device **device;         /* [n] */
    brc_simulation **simulation; /* [n] */
    brc_assembly assembly;       /* of them; n = 0 until they are there */
} brc_setup;

/* Split the scene and build its domains, or take the one given (of a scene of one model; NULL: built), and hand out
 * what the stages ask. scene and given are borrowed until the setup is freed. */
brc_status brc_setup_domains(brc_context *context, brc_scene *scene, const brc_domain *given, int n_threads,
                             brc_setup *setup);
/* Correct the laws of the beams that ask for it (beam_polish.h): seconds of tests. */
brc_status brc_setup_polish(brc_context *context, int n_threads, brc_setup *setup);
/* A device for every part, as asked but for many_materials, and the simulations on them. */
brc_status brc_setup_simulations(brc_context *context, const brc_device_request *request, brc_setup *setup);
/* Only the simulations; devices and domains stay. */
void brc_setup_free_simulations(brc_setup *setup);
/* A setup begins as {0}; what is not there is left alone. */
void brc_setup_free(brc_setup *setup);
/* Elements and bonds of all parts. */
int64_t brc_setup_n_elements(const brc_setup *setup);
int64_t brc_setup_n_bonds(const brc_setup *setup);
/* Elements along the longest edge of the domains' boxes, of the part that has most [-]. */
double brc_setup_across(const brc_setup *setup);

#endif
