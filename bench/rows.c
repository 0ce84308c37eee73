/* Rows of figures. */
#include "rows.h"
#include "../host/base/file.h"
#include "../host/base/memory.h"
#include "../host/base/version.h"
#include "../host/output/text.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

void brc_rows_begin(brc_rows *rows)
{
    if (rows->status != BRC_OK) return;
    if (rows->n_rows == rows->capacity) {
        const int64_t capacity = rows->capacity ? 2 * rows->capacity : 16;
        rows->status =
            brc_memory_resize(rows->context, (void **)&rows->rows, capacity, sizeof *rows->rows, "rows of figures");
        if (rows->status != BRC_OK) return;
        rows->capacity = capacity;
    }
    rows->rows[rows->n_rows++].n_fields = 0;
}

/* The field of this key in the last row, made when it is not there; NULL when it has no room or no row was begun. */
static brc_field *field_of(brc_rows *rows, const char *key, brc_field_kind kind)
{
    if (rows->status != BRC_OK || rows->n_rows == 0) return NULL;
    brc_row *row = &rows->rows[rows->n_rows - 1];
    int k = 0;
    while (k < row->n_fields && strcmp(row->fields[k].key, key) != 0)
        ++k;
    if (k == BRC_FIELDS_MOST) {
        rows->status =
            BRC_FAIL(rows->context, BRC_INTERNAL, "a row of figures has more than %d fields", BRC_FIELDS_MOST);
        return NULL;
    }
    brc_field *field = &row->fields[k];
    memset(field, 0, sizeof *field);
    snprintf(field->key, sizeof field->key, "%s", key);
    field->kind = kind;
    if (k == row->n_fields) ++row->n_fields;
    return field;
}

void brc_rows_number(brc_rows *rows, const char *key, double value)
{
    brc_field *field = field_of(rows, key, BRC_FIELD_NUMBER);
    if (field) field->number = value;
}

void brc_rows_integer(brc_rows *rows, const char *key, int64_t value)
{
    brc_field *field = field_of(rows, key, BRC_FIELD_INTEGER);
    if (field) field->integer = value;
}

void brc_rows_text(brc_rows *rows, const char *key, const char *value)
{
    brc_field *field = value ? field_of(rows, key, BRC_FIELD_TEXT) : NULL;
    if (field) snprintf(field->text, sizeof field->text, "%s", value);
}

const brc_field *brc_row_find(const brc_row *row, const char *key)
{
    for (int k = 0; k < row->n_fields; ++k)
        if (strcmp(row->fields[k].key, key) == 0) return &row->fields[k];
    return NULL;
}

double brc_row_number(const brc_row *row, const char *key)
{
    const brc_field *field = brc_row_find(row, key);
    return !field || field->kind == BRC_FIELD_TEXT ? NAN
           : field->kind == BRC_FIELD_INTEGER      ? (double)field->integer
                                                   : field->number;
}

const char *brc_row_text(const brc_row *row, const char *key)
{
    const brc_field *field = brc_row_find(row, key);
    return field ? field->text : "";
}

void brc_rows_stamp(brc_rows *rows)
{
    char date[32];
    const time_t now = time(NULL);
    struct tm parts;
    strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
    brc_rows_text(rows, "version", brc_version());
    brc_rows_text(rows, "commit", brc_version_commit());
    brc_rows_text(rows, "compiler", brc_version_compiler());
    brc_rows_text(rows, "date", date);
}

static brc_status write_json(const brc_rows *rows, const char *path)
{
    brc_json json = {.text = {.context = rows->context}};
    brc_json_begin_array(&json, NULL);
    for (int64_t r = 0; r < rows->n_rows; ++r) {
        brc_json_begin_object(&json, NULL);
        for (int k = 0; k < rows->rows[r].n_fields; ++k) {
            const brc_field *field = &rows->rows[r].fields[k];
            if (field->kind == BRC_FIELD_TEXT)
                brc_json_string(&json, field->key, field->text);
            else if (field->kind == BRC_FIELD_INTEGER)
                brc_json_integer(&json, field->key, field->integer);
            else
                brc_json_number(&json, field->key, field->number);
        }
        brc_json_end(&json);
    }
    return brc_json_write(&json, path);
}

/* Quoted as CSV wants it: always, quotation marks doubled. */
static void add_quoted(brc_text *text, const char *value)
{
    brc_text_add(text, "\"");
    for (; *value; ++value)
        brc_text_add_bytes(text, *value == '"' ? "\"\"" : value, *value == '"' ? 2 : 1);
    brc_text_add(text, "\"");
}

static brc_status write_csv(const brc_rows *rows, const char *path)
{
    brc_text text = {.context = rows->context};
    const char *keys[4 * BRC_FIELDS_MOST];
    int n_keys = 0;
    for (int64_t r = 0; r < rows->n_rows; ++r)
        for (int k = 0; k < rows->rows[r].n_fields; ++k) {
            int known = 0;
            while (known < n_keys && strcmp(keys[known], rows->rows[r].fields[k].key) != 0)
                ++known;
            if (known == n_keys && n_keys < (int)(sizeof keys / sizeof *keys))
                keys[n_keys++] = rows->rows[r].fields[k].key;
        }
    for (int k = 0; k < n_keys; ++k)
        brc_text_add(&text, "%s%s", k ? "," : "", keys[k]);
    brc_text_add(&text, "\n");
    for (int64_t r = 0; r < rows->n_rows; ++r) {
        for (int k = 0; k < n_keys; ++k) {
            const brc_field *field = brc_row_find(&rows->rows[r], keys[k]);
            if (k) brc_text_add(&text, ",");
            if (!field || (field->kind == BRC_FIELD_NUMBER && isnan(field->number))) continue;
            if (field->kind == BRC_FIELD_TEXT)
                add_quoted(&text, field->text);
            else if (field->kind == BRC_FIELD_INTEGER)
                brc_text_add(&text, "%lld", (long long)field->integer);
            else
                brc_text_add_number(&text, field->number);
        }
        brc_text_add(&text, "\n");
    }
    const brc_status status = brc_text_write(&text, path);
    brc_text_free(&text);
    return status;
}

brc_status brc_rows_write(const brc_rows *rows, const char *folder)
{
    BRC_TRY(rows->status);
    BRC_TRY(brc_file_make_folder(rows->context, folder));
    char *path;
    BRC_TRY(brc_file_join(rows->context, folder, "rows.json", &path));
    brc_status status = write_json(rows, path);
    brc_memory_free(path);
    if (status != BRC_OK) return status;
    BRC_TRY(brc_file_join(rows->context, folder, "rows.csv", &path));
    status = write_csv(rows, path);
    brc_memory_free(path);
    return status;
}

void brc_rows_free(brc_rows *rows)
{
    brc_memory_free(rows->rows);
    memset(rows, 0, sizeof *rows);
}
