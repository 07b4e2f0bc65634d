/*
 * Reads the body of a table such as VERTICES or FACETS in one pass: the head once, then rows as long as they come.
 *
 * A layout is a string of `n`, a number, and `v`, a vector `< n, n, n >`. White space and nested comments may stand
 * between any two of them. Reading stops at the first byte that does not fit; the rows before it are kept.
 */
#ifndef M3D_TABLE_READER_H
#define M3D_TABLE_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The longest layout, and the most numbers that a head or a row can hold. */
#define TABLE_READER_LONGEST 32
#define TABLE_READER_WIDEST (3 * TABLE_READER_LONGEST)

typedef struct {
    const uint8_t *text;  /* offsets count from here */
    const uint8_t *at;    /* next to be read; where it stopped, once it has */
    const uint8_t *end;
    char head[TABLE_READER_LONGEST + 1], row[TABLE_READER_LONGEST + 1];
    size_t head_width, row_width; /* numbers in each */
    const char *expected; /* at the place where it stopped; NULL: the text ended with a whole row */
} TableReader;

/* Whether bytes are all such as a table of numerals and vectors without comments is made of. */
bool table_reader_only_numbers(const uint8_t *from, const uint8_t *to);

/* To be called once, before all else: numbers are read with a point, whatever the locale of the process. */
void table_reader_prepare(void);

/* False when a layout is not one. */
bool table_reader_init(TableReader *reader, const uint8_t *text, size_t start, size_t end, const char *head,
                       const char *row);

/* Reads the head into as many numbers as it has. False: the text stops fitting in it. */
bool table_reader_head(TableReader *reader, double *values);

/*
 * Reads rows from number `count` on into arrays with room for `room` of them, and the byte offset of each. Returns how
 * many there are now: less than `room` when there are no more.
 */
size_t table_reader_rows(TableReader *reader, double *rows, void *offsets, size_t offset_size, size_t count,
                         size_t room);

#endif
