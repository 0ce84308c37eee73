/* What the report page tables of summary.json. */
#ifndef BRC_OUTPUT_REPORT_SUMMARY_H
#define BRC_OUTPUT_REPORT_SUMMARY_H

#include "html.h"

/* The text of a scalar of a map, "" where it is missing or null; map may be NULL. */
const char *brc_report_summary_text(const brc_node *map, const char *key);
/* The title of the scene; without one the folder. */
const char *brc_report_summary_title(const brc_node *summary, const char *folder);
/* Title, what ran, how it ended. */
void brc_report_summary_head(brc_text *page, const brc_node *summary, const char *folder);
/* Measures and figures of fracture; nothing where there are none. */
void brc_report_summary_results(brc_text *page, const brc_node *summary);
/* Ledger, timing and memory, with shares. */
void brc_report_summary_cost(brc_text *page, const brc_node *summary);
/* Everything that the others have not shown, section by section, folded away. */
void brc_report_summary_rest(brc_text *page, const brc_node *summary);

#endif
