#include "statics_peer.h"
#include "../host/base/file.h"
#include "../host/base/log.h"
#include "../host/base/memory.h"
#include "peer.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define OUTPUT_BYTES_MOST ((size_t)16 << 20)

struct brc_statics_peer {
    char python[512];
    char *script, *output; /* paths; owned */
};

/* Does this Python have what the script imports? */
static brc_status has_fenics(brc_context *context, const char *python, const char *output, bool *out)
{
    const char *const words[BRC_PEER_WORDS_MOST] = {python, "-c", "import dolfinx, petsc4py"};
    int state = -1;
    BRC_TRY(brc_peer_spawn(context, words, output, &state));
    *out = state == 0;
    return BRC_OK;
}

static brc_status find_python(brc_context *context, brc_statics_peer *peer, bool *found)
{
    static const char debian[] = "/usr/bin/python3";
    *found = false;
    if (brc_peer_on_path("python3", peer->python, sizeof peer->python))
        BRC_TRY(has_fenics(context, peer->python, peer->output, found));
    if (*found || access(debian, X_OK) != 0) return BRC_OK;
    snprintf(peer->python, sizeof peer->python, "%s", debian);
    return has_fenics(context, peer->python, peer->output, found);
}

brc_status brc_statics_peer_find(brc_context *context, const char *folder, const char *name, const char *script,
                                 brc_statics_peer **out)
{
    char printed[128];
    bool found = false;
    brc_statics_peer *peer = NULL;
    brc_status status = BRC_OK;
    *out = NULL;
    snprintf(printed, sizeof printed, "%s.txt", name);
    BRC_TRY(BRC_ALLOCATE(context, &peer, 1, "peer of bench statics"));
    BRC_TRY_OR(cleanup, brc_file_make_folder(context, folder));
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, name, &peer->script));
    BRC_TRY_OR(cleanup, brc_file_join(context, folder, printed, &peer->output));
    BRC_TRY_OR(cleanup, find_python(context, peer, &found));
    if (found) {
        BRC_TRY_OR(cleanup, brc_file_write_whole(context, peer->script, script, strlen(script)));
        *out = peer;
        return BRC_OK;
    }
    brc_log(context, BRC_LOG_INFO,
            "finite elements are left out: no python3 has dolfinx (Debian: apt-get install python3-dolfinx)");
cleanup:
    brc_statics_peer_free(&peer);
    return status;
}

void brc_statics_peer_free(brc_statics_peer **peer)
{
    if (!*peer) return;
    brc_memory_free((*peer)->script);
    brc_memory_free((*peer)->output);
    brc_memory_free(*peer);
    *peer = NULL;
}

void brc_statics_peer_read(const char *text, brc_statics_peer_result *out)
{
    const struct {
        const char *key;
        double *to;
    } known[] = {{"nodes", &out->nodes}, {"iterations", &out->iterations}, {"assembly", &out->assembly},
                 {"setup", &out->setup}, {"seconds", &out->seconds},       {"resident", &out->resident}};
    *out = (brc_statics_peer_result){"", NAN, NAN, NAN, NAN, NAN, NAN};
    for (const char *line = text; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        char key[32];
        double number;
        sscanf(line, "breccia-peer version %63s", out->version);
        if (sscanf(line, "breccia-peer %31s %lf", key, &number) != 2) continue;
        for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
            if (strcmp(known[k].key, key) == 0) *known[k].to = number;
    }
}

brc_status brc_statics_peer_row(brc_context *context, const brc_statics_peer *peer, const brc_statics_peer_body *body,
                                brc_rows *rows)
{
    char nodes[32], poisson[32], last[100] = "";
    char *text = NULL;
    size_t bytes;
    int state = -1;
    brc_statics_peer_result r;
    snprintf(nodes, sizeof nodes, "%lld", (long long)body->elements);
    snprintf(poisson, sizeof poisson, "%.17g", body->poisson);
    const char *const words[BRC_PEER_WORDS_MOST] = {peer->python, peer->script, body->name, nodes, poisson, "1e-10"};
    BRC_TRY(brc_peer_spawn(context, words, peer->output, &state));
    BRC_TRY(brc_file_read_whole(context, peer->output, OUTPUT_BYTES_MOST, &text, &bytes));
    brc_statics_peer_read(text, &r);
    if (!(r.seconds > 0)) {
        brc_peer_last_line(text, last, sizeof last);
        if (!last[0]) snprintf(last, sizeof last, "it told no seconds");
    }
    brc_memory_free(text);
    brc_rows_begin(rows);
    brc_rows_text(rows, "bench", "statics");
    brc_rows_text(rows, "body", body->name);
    brc_rows_text(rows, "program", "fenicsx");
    brc_rows_text(rows, "law", "trilinear hexahedra, GAMG");
    brc_rows_number(rows, "poisson", body->poisson);
    brc_rows_number(rows, "elements", r.nodes);
    brc_rows_number(rows, "iterations", r.iterations);
    brc_rows_number(rows, "seconds", r.seconds);
    brc_rows_number(rows, "setup_s", r.setup);
    brc_rows_number(rows, "assembly_s", r.assembly);
    brc_rows_number(rows, "ratio", r.seconds / body->ours);
    brc_rows_number(rows, "most_resident_bytes", r.resident);
    brc_rows_integer(rows, "threads", 1);
    brc_rows_text(rows, "note", last);
    brc_rows_stamp(rows);
    brc_rows_text(rows, "version", r.version); /* its own */
    return rows->status;
}
