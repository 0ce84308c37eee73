/* The histogram as a surface in files other programs read. */
#include "isotropy.h"
#include "../../host/base/file.h"
#include "../../host/base/memory.h"
#include <errno.h>
#include <math.h>
#include <string.h>

static void corner(const brc_isotropy *i, int32_t bin, double x[3])
{
    for (int c = 0; c < 3; ++c)
        x[c] = i->density[bin] * i->direction[3 * (int64_t)bin + c];
}

static void write_numbers(FILE *file, const char *name, int64_t n, const double *v)
{
    fprintf(file, "<DataArray type=\"Float64\" Name=\"%s\" format=\"ascii\">\n", name);
    for (int64_t k = 0; k < n; ++k)
        fprintf(file, "%.17g\n", v[k]);
    fputs("</DataArray>\n", file);
}

static void write_vtp(FILE *file, const brc_isotropy *i)
{
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<PolyData>\n",
          file);
    fprintf(file,
            "<Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"%d\">\n",
            (int)i->n_bins, (int)i->n_triangles);
    fputs("<PointData Scalars=\"density\">\n", file);
    write_numbers(file, "density", i->n_bins, i->density);
    write_numbers(file, "count", i->n_bins, i->count);
    write_numbers(file, "solid_angle", i->n_bins, i->solid_angle);
    fputs("</PointData>\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n",
          file);
    for (int32_t b = 0; b < i->n_bins; ++b) {
        double x[3];
        corner(i, b, x);
        fprintf(file, "%.17g %.17g %.17g\n", x[0], x[1], x[2]);
    }
    fputs("</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n",
          file);
    for (int64_t t = 0; t < i->n_triangles; ++t)
        fprintf(file, "%d %d %d\n", (int)i->triangle[3 * t], (int)i->triangle[3 * t + 1], (int)i->triangle[3 * t + 2]);
    fputs("</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n", file);
    for (int64_t t = 1; t <= i->n_triangles; ++t)
        fprintf(file, "%d\n", (int)(3 * t));
    fputs("</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n", file);
}

/* Little-endian, whatever the machine. */
static void put_word(FILE *file, uint32_t word)
{
    for (int k = 0; k < 4; ++k)
        fputc((int)(word >> 8 * k & 255), file);
}

static void put_vector(FILE *file, const double x[3])
{
    for (int c = 0; c < 3; ++c) {
        const float number = (float)x[c];
        uint32_t word;
        memcpy(&word, &number, sizeof word);
        put_word(file, word);
    }
}

static void write_stl(FILE *file, const brc_isotropy *i)
{
    char head[80] = "directions of bonds: radius = density, 1 where even"; /* may not begin with the word solid */
    fwrite(head, 1, sizeof head, file);
    put_word(file, (uint32_t)i->n_triangles);
    for (int64_t t = 0; t < i->n_triangles; ++t) {
        double x[3][3], normal[3];
        for (int k = 0; k < 3; ++k)
            corner(i, i->triangle[3 * t + k], x[k]);
        for (int c = 0; c < 3; ++c) {
            const int p = (c + 1) % 3, q = (c + 2) % 3;
            normal[c] = (x[1][p] - x[0][p]) * (x[2][q] - x[0][q]) - (x[1][q] - x[0][q]) * (x[2][p] - x[0][p]);
        }
        const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        for (int c = 0; c < 3; ++c)
            normal[c] = length > 0 ? normal[c] / length : 0;
        put_vector(file, normal);
        for (int k = 0; k < 3; ++k)
            put_vector(file, x[k]);
        fputc(0, file);
        fputc(0, file);
    }
}

brc_status brc_isotropy_write_surface(brc_context *context, const brc_isotropy *isotropy, const char *path)
{
    brc_status status = BRC_OK;
    char *aside = NULL;
    const size_t length = strlen(path);
    BRC_TRY_OR(cleanup, brc_file_aside(context, path, &aside));
    errno = 0;
    FILE *file = fopen(aside, "wb");
    if (!file) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot be written: %s", path, strerror(errno));
        goto cleanup;
    }
    if (length > 4 && strcmp(path + length - 4, ".stl") == 0)
        write_stl(file, isotropy);
    else
        write_vtp(file, isotropy);
    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        status = BRC_FAIL(context, BRC_FILE_FAILED, "%s: cannot be written: %s", path, strerror(errno));
        goto cleanup;
    }
    BRC_TRY_OR(cleanup, brc_file_commit(context, aside, path));
cleanup:
    if (status != BRC_OK) brc_file_discard(aside);
    brc_memory_free(aside);
    return status;
}
