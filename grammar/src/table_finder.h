/*
 * Finds the long tables of a text without parsing it, many times faster than a parser passes them.
 */
#ifndef M3D_TABLE_FINDER_H
#define M3D_TABLE_FINDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const uint8_t *at, *end;  /* next to be looked at */
    const char *keywords;     /* those of tables, with a blank before and after each */
    size_t least;             /* how many bytes make a table long */
} TableFinder;

/*
 * The next long body `{ ... }` that follows the keyword of a table and holds nothing but numbers, punctuation, white
 * space and comments, as the bytes after its first brace and before its last. False: there is none.
 */
bool table_finder_next(TableFinder *finder, const uint8_t **start, const uint8_t **end);

#endif
