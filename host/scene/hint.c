#include "hint.h"
#include "unit.h"
#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#define DEEP 4 /* sections below the one at hand in which a key is looked for */

/* Words of the field, of other programs and of other spellings; a word may stand for several keys, the first that a
 * section has. */
static const struct {
    const char *word, *key;
} SYNONYM[] = {
    {"young", "E"},
    {"youngs_modulus", "E"},
    {"young_modulus", "E"},
    {"modulus", "E"},
    {"poisson", "nu"},
    {"poissons_ratio", "nu"},
    {"poisson_ratio", "nu"},
    {"v", "nu"},
    {"rho", "density"},
    {"tensile", "tension"},
    {"tensile_strength", "tension"},
    {"tensile_strength", "strength"},
    {"sigma_t", "tension"},
    {"ft", "tension"},
    {"f_t", "tension"},
    {"ucs", "compression"},
    {"compressive", "compression"},
    {"compressive_strength", "compression"},
    {"gc", "fracture_energy"},
    {"g_c", "fracture_energy"},
    {"gf", "fracture_energy"},
    {"g_f", "fracture_energy"},
    {"toughness", "fracture_energy"},
    {"disk", "cylinder"},
    {"disc", "cylinder"},
    {"rod", "cylinder"},
    {"plate", "box"},
    {"block", "box"},
    {"cube", "box"},
    {"beam", "box"},
    {"ball", "sphere"},
    {"ring", "torus"},
    {"difference", "parts"},
    {"union", "parts"},
    {"intersection", "parts"},
    {"hole", "parts"},
    {"stl", "mesh"},
    {"thickness", "length"},
    {"height", "length"},
    {"depth", "length"},
    {"center", "centre"},
    {"center", "origin"},
    {"centre", "origin"},
    {"position", "origin"},
    {"corner", "origin"},
    {"dimensions", "size"},
    {"dimension", "size"},
    {"lengths", "size"},
    {"x", "size"},
    {"y", "size"},
    {"z", "size"},
    {"grid", "noisy_grid"},
    {"voronoi", "noisy_grid"},
    {"cells", "noisy_grid"},
    {"cell_size", "spacing"},
    {"element_size", "spacing"},
    {"mesh_size", "spacing"},
    {"size", "spacing"},
    {"h", "spacing"},
    {"dx", "spacing"},
    {"number", "elements"},
    {"n", "elements"},
    {"spheres", "packing"},
    {"body", "bodies"},
    {"material", "materials"},
    {"stage", "stages"},
    {"steps", "stages"},
    {"sensor", "sensors"},
    {"set", "sets"},
    {"mu", "friction"},
    {"friction_coefficient", "friction"},
    {"time", "duration"},
    {"end_time", "duration"},
    {"t_end", "duration"},
    {"total_time", "duration"},
    {"dt", "time_step"},
    {"timestep", "time_step"},
    {"damping", "mass_damping"},
    {"explicit", "dynamic"},
    {"transient", "dynamic"},
    {"implicit", "static"},
    {"quasistatic", "static"},
    {"quasi_static", "static"},
    {"quasi-static", "static"},
    {"modal", "modes"},
    {"min", "from"},
    {"max", "to"},
    {"lower", "from"},
    {"upper", "to"},
    {"max", "peak"},
    {"maximum", "peak"},
    {"average", "mean"},
    {"force", "reaction"},
    {"load", "reaction"},
    {"displacement", "face_mean"},
    {"velocity", "face_velocity"},
    {"displacement", "face_displacement"},
    {"force", "element_force"},
    {"stress", "traction"},
    {"cmod", "opening"},
    {"crack_opening", "opening"},
    {"cod", "opening"},
    {"every", "history_every"},
    {"frame_every", "frame_interval"},
    {"sampling", "history_every"},
    {"load", "loads"},
    {"boundary_conditions", "loads"},
    {"initial_velocity", "initial"},
    {"initial_conditions", "initial"},
    {"walls", "strikers"},
    {"platen", "platens"},
    {"jaw", "jaws"},
    {"roller", "rollers"},
    {"supports", "rollers"},
    {"notch", "cracks"},
    {"notches", "cracks"},
    {"slit", "cracks"},
    {"crack", "cracks"},
    {"clamp", "face_displacement"},
    {"clamped", "face_displacement"},
    {"fixed", "face_displacement"},
    {"fix", "face_displacement"},
    {"support", "face_displacement"},
    {"gap", "skin"},
    {"value", "target"},
    {"lattice", "dlsm"},
    {"bpm", "cbm"},
    {"velocity", "speed"},
    {"rate", "speed"},
    {"direction", "axis"},
    {"direction", "component"},
    {"quantity", "component"},
    {"m", "modulus"},
};

static const char *synonym(const brc_section *section, const char *key)
{
    for (size_t k = 0; k < sizeof SYNONYM / sizeof *SYNONYM; ++k)
        if (strcasecmp(SYNONYM[k].word, key) == 0 && strcmp(SYNONYM[k].key, key) != 0 &&
            brc_section_find(section, SYNONYM[k].key))
            return SYNONYM[k].key;
    return NULL;
}

/* "strength: {inner: ...}", with the brackets of lists and maps of names. */
static void enclose(const brc_entry *entry, const char *inner, char *out, size_t room)
{
    const bool list = entry->type == BRC_TYPE_LIST, named = entry->type == BRC_TYPE_NAMED;
    snprintf(out, room, "%s: %s{%.150s}%s", entry->key,
             list    ? "["
             : named ? "{NAME: "
                     : "",
             inner,
             list    ? "]"
             : named ? "}"
                     : "");
}

/* The nearest section below `section`, at most `deep` of them, that has the key; its path into `path`, from the front.
 * Lists and maps of names stand as [...] and {NAME: ...}. */
static bool find_below(const brc_section *section, const char *key, int deep, char *path, size_t room)
{
    for (int k = 0; k < section->n_entries; ++k) {
        const brc_entry *entry = &section->entries[k];
        if (!entry->section || !brc_section_find(entry->section, key)) continue;
        char inner[BRC_HINT];
        snprintf(inner, sizeof inner, "%s: ...", key);
        enclose(entry, inner, path, room);
        return true;
    }
    for (int k = 0; k < section->n_entries && deep > 1; ++k) {
        const brc_entry *entry = &section->entries[k];
        char rest[BRC_HINT];
        if (!entry->section || !find_below(entry->section, key, deep - 1, rest, sizeof rest)) continue;
        enclose(entry, rest, path, room);
        return true;
    }
    return false;
}

const char *brc_hint_key(const brc_problems *problems, const brc_section *section, const char *key, char out[BRC_HINT])
{
    const char *words[64], *meant = synonym(section, key);
    int n = 0;
    char path[BRC_HINT];
    out[0] = '\0';
    for (; n < section->n_entries && n < 64; ++n)
        words[n] = section->entries[n].key;
    if (!meant) meant = brc_problems_nearest(problems, key, n, words);
    if (meant)
        snprintf(out, BRC_HINT, "; did you mean '%s'?", meant);
    else if (find_below(section, key, DEEP, path, sizeof path))
        snprintf(out, BRC_HINT, "; it belongs further in, as in %.200s", path);
    else if (strchr(key, ':'))
        snprintf(out, BRC_HINT, "; a blank belongs behind the colon of a key");
    else if (isdigit((unsigned char)key[0]))
        snprintf(out, BRC_HINT, "; a comma ends a value: decimals have a point");
    return out;
}

/* The unit in capitals and small letters as it should be: Gpa, MPA, Mm. */
static bool recase(const char *text, const char *unit, char *out, size_t room)
{
    static const char *const KNOWN[] = {"Pa",     "kPa",   "MPa", "GPa", "nm",   "um",   "mm",   "cm",  "m",   "km",
                                        "ns",     "us",    "ms",  "s",   "min",  "h",    "g",    "kg",  "N",   "kN",
                                        "MN",     "J",     "kJ",  "W",   "Hz",   "kHz",  "MHz",  "rad", "deg", "kg/m^3",
                                        "g/cm^3", "J/m^2", "N/m", "m/s", "mm/s", "km/s", "m/s^2"};
    const size_t number = strspn(text, "+-.0123456789eE");
    const char *rest = text + number + strspn(text + number, " ");
    double value;
    for (size_t k = 0; k < sizeof KNOWN / sizeof *KNOWN; ++k) {
        if (strcasecmp(rest, KNOWN[k]) != 0) continue;
        snprintf(out, room, "%.*s %s", (int)(number < 60 ? number : 60), text, KNOWN[k]);
        if (brc_quantity_read(out, unit, &value) == BRC_QUANTITY_OK) return true;
    }
    return false;
}

/* Powers without their sign: kg/m3, mm2. */
static bool add_powers(const char *text, const char *unit, char *out, size_t room)
{
    size_t at = 0;
    double value;
    bool any = false;
    for (const char *c = text; *c && at + 3 < room; ++c) {
        const bool power = c > text && isalpha((unsigned char)c[-1]) && isdigit((unsigned char)*c) &&
                           strspn(text, "+-.0123456789eE ") < (size_t)(c - text);
        if (power) out[at++] = '^';
        any |= power;
        out[at++] = *c;
    }
    out[at] = '\0';
    return any && brc_quantity_read(out, unit, &value) == BRC_QUANTITY_OK;
}

const char *brc_hint_quantity(const char *text, const char *unit, char out[BRC_HINT])
{
    static const struct {
        const char *word, *unit;
    } SPELT[] = {{"sec", "s"},       {"second", "s"},  {"seconds", "s"},  {"degree", "deg"},
                 {"degrees", "deg"}, {"micron", "um"}, {"microns", "um"}, {"percent", "%"},
                 {"Newton", "N"},    {"meter", "m"},   {"metre", "m"}};
    char meant[96];
    double value;
    const size_t number = strspn(text, "+-.0123456789eE"), room = sizeof meant;
    const char *rest = text + number + strspn(text + number, " ");
    out[0] = '\0';
    bool found = strlen(text) < 64 && (recase(text, unit, meant, room) || add_powers(text, unit, meant, room));
    for (size_t k = 0; k < sizeof SPELT / sizeof *SPELT && !found && strlen(text) < 64; ++k) {
        if (strcasecmp(rest, SPELT[k].word) != 0) continue;
        snprintf(meant, room, "%.*s %s", (int)number, text, SPELT[k].unit);
        found = brc_quantity_read(meant, unit, &value) == BRC_QUANTITY_OK;
    }
    if (found)
        snprintf(out, BRC_HINT, "; did you mean '%s'?", meant);
    else if (number > 0 && text[number] == ',' && isdigit((unsigned char)text[number + 1]))
        snprintf(out, BRC_HINT, "; decimals have a point, not a comma");
    return out;
}

const char *brc_hint_range(const brc_entry *entry, const char *text, double value, char out[BRC_HINT])
{
    const bool share = (!entry->unit || entry->unit[0] == '\0') && entry->range.high == 1 && entry->range.low >= 0;
    out[0] = '\0';
    if (share && entry->type == BRC_TYPE_QUANTITY && value > 1 && value <= 100 && !strchr(text, '%'))
        snprintf(out, BRC_HINT, "; did you mean '%.20s %%'?", text);
    return out;
}

/* What a key's value may look like. */
static const char *sample_of(const brc_entry *entry)
{
    if (entry->sample) return entry->sample;
    if (entry->given && strcmp(entry->given, "{}") != 0) return entry->given;
    return entry->choices ? entry->choices[0] : "...";
}

const char *brc_hint_map(const brc_section *section, const char *key, char out[BRC_HINT])
{
    size_t at = 0;
    out[0] = '\0';
    if (!section || section->n_entries == 0 || section->one_of) return out;
    for (int k = 0; k < section->n_entries && at < BRC_HINT - 1; ++k) {
        const brc_entry *entry = &section->entries[k];
        bool wanted = entry->required;
        for (size_t g = 0; g < sizeof section->groups / sizeof *section->groups; ++g) {
            const brc_group *group = &section->groups[g];
            const bool due = group->rule == BRC_GROUP_EXACTLY_ONE || group->rule == BRC_GROUP_AT_LEAST_ONE;
            wanted |= due && strcmp(group->keys[0], entry->key) == 0;
        }
        if (wanted)
            at += (size_t)snprintf(out + at, BRC_HINT - at, "%s%s: %s", at ? ", " : "", entry->key, sample_of(entry));
    }
    if (at == 0) snprintf(out, BRC_HINT, "%s: %s", section->entries[0].key, sample_of(&section->entries[0]));
    char text[BRC_HINT];
    snprintf(text, sizeof text, "; as in %.40s: {%.250s}", key, out);
    memcpy(out, text, sizeof text);
    return out;
}

const char *brc_hint_list(const brc_entry *entry, char out[BRC_HINT])
{
    const brc_section *section = entry->section;
    const char *name = section->sample_name ? section->sample_name : "NAME";
    if (entry->type == BRC_TYPE_NAMED)
        snprintf(out, BRC_HINT, "; write a name for each in place of '-', as in %s: {%s: ...}", entry->key, name);
    else if (brc_section_find(section, "name"))
        snprintf(out, BRC_HINT, "; begin each with '- name: ...'");
    else
        snprintf(out, BRC_HINT, "; begin each with '- %s: ...'", section->entries[0].key);
    return out;
}
