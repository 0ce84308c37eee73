/* Pieces of a page that stands alone: escaped words, values of a JSON file, pictures inside the page. */
#ifndef BRC_OUTPUT_HTML_H
#define BRC_OUTPUT_HTML_H

#include "../text.h"
#include "../../scene/node.h"

/* Head with title and style, and the end of the page. */
void brc_html_begin(brc_text *page, const char *title);
void brc_html_end(brc_text *page);
/* Words with what HTML would read as marks escaped. */
void brc_html_words(brc_text *page, const char *words);
/* The name of a value of summary.json without its unit: "peak_elastic_J" is "peak elastic". */
void brc_html_key(brc_text *page, const char *key);
/* A number with five digits in the unit that `key` ends in, prefixed as suits it, the whole one on hovering; anything
 * else as words; null is a dash. `key` may be NULL: no unit. */
void brc_html_scalar(brc_text *page, const char *key, const char *text);
/* Any value: a scalar, a map as a table of two columns, a list of maps (or a map of maps) as one with a column a key,
 * another list as words with semicolons. */
void brc_html_value(brc_text *page, const char *key, const brc_node *node);
/* A file of web/ as it is (web_file.h). */
void brc_html_file(brc_text *page, const char *name);
/* Bytes in base64 as an element of this id, which scripts of the page read; packed: by gzip or zlib. */
void brc_html_packed(brc_text *page, const char *id, const void *packed, size_t n);
/* Bytes packed by zlib and added as above. BRC_NO_MEMORY; also kept in the page. */
brc_status brc_html_array(brc_text *page, const char *id, const void *bytes, int64_t n);
/* What is open is ended, and the whole is added as an element of this id; then json is freed. */
void brc_html_json(brc_text *page, const char *id, brc_json *json);
/* A PNG as <img> with its bytes inside. */
void brc_html_picture(brc_text *page, const char *words, const void *bytes, size_t n);

#endif
