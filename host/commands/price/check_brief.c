#include "check_brief.h"
#include <math.h>

/* Mean size of the elements of a part: cube root of a cell's volume, diameter of a sphere [m]. */
static double mean_size(const brc_domain *d)
{
    double sum = 0;
    for (int64_t e = 0; e < d->n_elements; ++e)
        sum += d->element_kind == BRC_ELEMENT_SPHERE ? 2 * d->radius[e] : cbrt(d->volume[e]);
    return sum / (double)d->n_elements;
}

static const char *kind_of(const brc_domain *d)
{
    return d->element_kind == BRC_ELEMENT_SPHERE ? "spheres" : "cells";
}

void brc_check_brief_setup(FILE *file, const brc_scene *scene, const brc_setup *setup, brc_precision precision)
{
    const brc_device_info *info = brc_device_get_info(setup->device[0]);
    const brc_assembly *a = &setup->assembly;
    fprintf(file, "scene: %s\n", scene->title[0] ? scene->title : "without a title");
    fprintf(file, "elements: %lld, %lld bonds;", (long long)brc_setup_n_elements(setup),
            (long long)brc_setup_n_bonds(setup));
    for (int32_t k = 0; k < setup->n; ++k)
        fprintf(file, "%s %s of %.3g mm", k ? "," : "", kind_of(setup->domain[k]), 1e3 * mean_size(setup->domain[k]));
    fprintf(file, "\ndevice: %s (%s), %s precision\n", info->selector, info->name, brc_precision_name(precision));
    for (int32_t k = 0; k < a->n; ++k) {
        const char *const *effects = brc_simulation_effects_in(a->part[k]);
        fprintf(file, "simulated%s%s:", a->split && a->n > 1 ? " with " : "",
                a->split && a->n > 1 ? brc_assembly_part_name(a, k) : "");
        for (int m = 0; effects[m]; ++m)
            fprintf(file, "%s %s", m ? "," : "", effects[m]);
        fputs("\n", file);
    }
}

static void tell_stage(FILE *file, const brc_stage *stage, const brc_trial_stage *t)
{
    fprintf(file, "stage %s: ", stage->name);
    if (stage->solver == BRC_SOLVER_DYNAMIC)
        fprintf(file, "%lld steps of %.4g s (%s)\n", (long long)t->planned, t->time_step.value,
                t->time_step.governed_by);
    else if (stage->solver == BRC_SOLVER_MODES)
        fputs("modes\n", file);
    else if (stage->most_events > 0)
        fprintf(file, "static, at most %lld breaks one by one\n", (long long)t->planned);
    else
        fprintf(file, "static, %lld load steps\n", (long long)t->planned);
}

/* What cracks ask of the elements, material by material. */
static void tell_cracks(FILE *file, const brc_scene *scene, const brc_setup *setup)
{
    const brc_domain *d = setup->domain[0];
    const bool spheres = d->element_kind == BRC_ELEMENT_SPHERE;
    for (int32_t k = 0; scene->has_fracture && k < scene->n_materials; ++k) {
        const brc_material *m = &scene->materials[k];
        if (!(m->tension > 0)) continue;
        if (m->fracture_energy > 0) {
            const double length = m->young * m->fracture_energy / (m->tension * m->tension);
            fprintf(file, "cracks in %s: E G_c / sigma^2 is %.3g mm, %.3g %s; %s are wanted\n", m->name, 1e3 * length,
                    length / mean_size(d), kind_of(d),
                    spheres ? "4" : "4, in notched parts 8,"); /* docs/notebook/fracture.md */
        } else {
            fprintf(file,
                    "cracks in %s: no fracture_energy, so that their energy is what strength and %s make of it, and "
                    "the load of a notched part changes with the %s\n",
                    m->name, kind_of(d), kind_of(d));
        }
    }
}

void brc_check_brief_trial(FILE *file, const brc_scene *scene, const brc_setup *setup, const brc_trial *trial,
                           const brc_prediction_told *told)
{
    for (int32_t k = 0; k < trial->n_stages; ++k)
        if (trial->stages[k].ran) tell_stage(file, &scene->stages[k], &trial->stages[k]);
    if (told->known) {
        fprintf(file, "memory: %.4g MB on the host, %.4g MB on the device, %.4g MB resident; %.4g MB on disk\n",
                told->host_bytes / 1e6, told->device_bytes / 1e6, told->resident_bytes / 1e6, told->disk_bytes / 1e6);
        fprintf(file, "seconds: %.3g", told->seconds);
        if (told->least_seconds < told->seconds || told->most_seconds > told->seconds)
            fprintf(file, ", from %.3g to %.3g", told->least_seconds, told->most_seconds);
        fprintf(file, ", with building and output\n");
    } else {
        fprintf(file, "seconds: not known, the trial was stopped: %s\n", trial->reason);
    }
    tell_cracks(file, scene, setup);
}
