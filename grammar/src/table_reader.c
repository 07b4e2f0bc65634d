#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* strtod_l, newlocale */
#endif
#include "table_reader.h"

#include <float.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

/* What reads a row is one loop whose place in the text stays in a register. */
#if defined(__GNUC__)
#define ALWAYS_INLINE static inline __attribute__((always_inline))
#else
#define ALWAYS_INLINE static inline
#endif

/* --- numbers ---------------------------------------------------------------------------------------------------- */

#ifdef _WIN32
#define locale_t _locale_t
#define strtod_l _strtod_l
#endif

static locale_t c_locale;

void table_reader_prepare(void) {
    if (c_locale) return;
#ifdef _WIN32
    c_locale = _create_locale(LC_ALL, "C");
#else
    c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
#endif
}

/* Any numeral, correctly rounded. */
static double slow_value(const uint8_t *from, const uint8_t *to) {
    char small[128], *copy = small;
    size_t length = (size_t)(to - from);
    if (length >= sizeof small && !(copy = malloc(length + 1))) {
        copy = small; /* out of memory: its first 127 characters decide */
        length = sizeof small - 1;
    }
    memcpy(copy, from, length);
    copy[length] = '\0';
    double value = c_locale ? strtod_l(copy, NULL, c_locale) : strtod(copy, NULL);
    if (copy != small) free(copy);
    return value;
}

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

static inline bool is_digit(uint8_t c) {
    return (uint8_t)(c - '0') < 10;
}

static inline bool is_part_of_word(uint8_t c) {
    return is_digit(c) || (uint8_t)((c | 0x20) - 'a') < 26 || c == '_' || c == '.';
}

/*
 * Reads `[+-]? digits (. digits)? ([eE] [+-]? digits)?`. The value is exact where the digits make an integer below
 * 2^53 and the power of ten is at most 22 (both are then doubles, and one operation rounds once: Clinger 1990).
 */
ALWAYS_INLINE bool read_number(TableReader *reader, double *value) {
    const uint8_t *const from = reader->at, *const end = reader->end, *p = from;
    bool negative = false;
    if (p < end && (*p == '-' || *p == '+')) {
        negative = *p == '-';
        p++;
    }
    uint64_t digits = 0;
    const uint8_t *part = p;
    while (p < end && is_digit(*p)) digits = digits * 10 + (uint64_t)(*p++ - '0');
    if (p == part) {
        reader->expected = p == from ? "number" : "digit";
        reader->at = p;
        return false;
    }
    size_t length = (size_t)(p - part);
    int exponent = 0;
    if (p < end && *p == '.') {
        part = ++p;
        while (p < end && is_digit(*p)) digits = digits * 10 + (uint64_t)(*p++ - '0');
        if (p == part) {
            reader->expected = "digit";
            reader->at = p;
            return false;
        }
        length += (size_t)(p - part);
        exponent = length < 32 ? -(int)(p - part) : 0; /* of no use where there are too many digits */
    }
    if (p < end && (*p | 0x20) == 'e') {
        bool minus = false;
        int power = 0;
        p++;
        if (p < end && (*p == '-' || *p == '+')) minus = *p++ == '-';
        part = p;
        while (p < end && is_digit(*p)) {
            if (power < 100000) power = power * 10 + (*p - '0');
            p++;
        }
        if (p == part) {
            reader->expected = "digit";
            reader->at = p;
            return false;
        }
        exponent += minus ? -power : power;
    }
    if (p < end && is_part_of_word(*p)) {
        reader->expected = "space";
        reader->at = p;
        return false;
    }
    reader->at = p;
#if FLT_EVAL_METHOD == 0
    if (length <= 19 && digits <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22) {
        double magnitude = (double)digits;
        magnitude = exponent < 0 ? magnitude / power_of_ten[-exponent] : magnitude * power_of_ten[exponent];
        *value = negative ? -magnitude : magnitude;
        return true;
    }
#endif
    *value = slow_value(from, p);
    return true;
}

/* 0 for digits, signs, commas, points, exponents, the marks of vectors and white space. Compilers make sixteen or more
 * comparisons at once of it, where they see a loop of a fixed length and no branch. */
static inline uint8_t is_other(uint8_t c) {
    const uint8_t digit = c - '0', mark = c - '+', control = c - '\t', letter = c | 0x20, angle = c | 2;
    uint8_t other = digit > 9 ? 1 : 0;
    other = mark > '.' - '+' ? other : 0;
    other = control > '\r' - '\t' ? other : 0;
    other = letter != 'e' ? other : 0;
    other = angle != '>' ? other : 0;
    return c != ' ' ? other : 0;
}

bool table_reader_only_numbers(const uint8_t *from, const uint8_t *to) {
    enum { BLOCK = 256 };
    for (; to - from >= BLOCK; from += BLOCK) {
        uint8_t others = 0;
        for (int i = 0; i < BLOCK; i++) others |= is_other(from[i]);
        if (others) return false;
    }
    while (from < to && !is_other(*from)) from++;
    return from == to;
}

/* --- rows ------------------------------------------------------------------------------------------------------- */

static inline bool is_blank(uint8_t c) {
    return c == ' ' || (uint8_t)(c - '\t') < 5;
}

/* Where white space and comments end, or where a comment begins that is not closed. */
static const uint8_t *after_comments(const uint8_t *p, const uint8_t *end, bool *closed) {
    for (;;) {
        while (p < end && is_blank(*p)) p++;
        if (end - p < 2 || p[0] != '/' || p[1] != '*') break;
        const uint8_t *const from = p;
        size_t depth = 1;
        for (p += 2; depth > 0; ) {
            if (end - p < 2) {
                *closed = false;
                return from;
            }
            if (p[0] == '*' && p[1] == '/') {
                depth--;
                p += 2;
            } else if (p[0] == '/' && p[1] == '*') {
                depth++;
                p += 2;
            } else {
                p++;
            }
        }
    }
    *closed = true;
    return p;
}

/* Passes white space and comments. False: a comment is not closed; the reader stands at its beginning. */
ALWAYS_INLINE bool skip_blank(TableReader *reader) {
    const uint8_t *p = reader->at, *const end = reader->end;
    while (p < end && is_blank(*p)) p++;
    bool closed = true;
    if (p < end && *p == '/') p = after_comments(p, end, &closed);
    if (!closed) reader->expected = "*/";
    reader->at = p;
    return closed;
}

ALWAYS_INLINE bool read_mark(TableReader *reader, char mark, const char *name) {
    if (!skip_blank(reader)) return false;
    if (reader->at < reader->end && *reader->at == (uint8_t)mark) {
        reader->at++;
        return true;
    }
    reader->expected = name;
    return false;
}

ALWAYS_INLINE bool read_component(TableReader *reader, double *value) {
    return skip_blank(reader) && read_number(reader, value);
}

/* Reads what a layout says; the blank before its first item is already passed. */
ALWAYS_INLINE bool read_layout(TableReader *reader, const char *layout, double *values) {
    for (const char *item = layout; *item; item++) {
        if (*item == 'n') {
            if (!read_component(reader, values)) return false;
            values += 1;
        } else {
            if (!read_mark(reader, '<', "<") || !read_component(reader, values) || !read_mark(reader, ',', ",") ||
                !read_component(reader, values + 1) || !read_mark(reader, ',', ",") ||
                !read_component(reader, values + 2) || !read_mark(reader, '>', ">"))
                return false;
            values += 3;
        }
    }
    return true;
}

static bool set_layout(char *to, size_t *width, const char *layout) {
    size_t length = strlen(layout);
    if (length > TABLE_READER_LONGEST) return false;
    *width = 0;
    for (size_t i = 0; i < length; i++) {
        if (layout[i] != 'n' && layout[i] != 'v') return false;
        *width += layout[i] == 'n' ? 1 : 3;
    }
    memcpy(to, layout, length + 1);
    return true;
}

bool table_reader_init(TableReader *reader, const uint8_t *text, size_t start, size_t end, const char *head,
                       const char *row) {
    reader->text = text;
    reader->at = text + start;
    reader->end = text + end;
    reader->expected = NULL;
    return set_layout(reader->head, &reader->head_width, head) && set_layout(reader->row, &reader->row_width, row) &&
           reader->row_width > 0;
}

bool table_reader_head(TableReader *reader, double *values) {
    return read_layout(reader, reader->head, values);
}

size_t table_reader_rows(TableReader *const given, double *rows, void *offsets, size_t offset_size, size_t count,
                         size_t room) {
    TableReader copy = *given, *const reader = &copy;
    for (; count < room; count++) {
        if (!skip_blank(reader) || reader->at == reader->end) break;
        size_t offset = (size_t)(reader->at - reader->text);
        if (offset_size == sizeof(uint32_t))
            ((uint32_t *)offsets)[count] = (uint32_t)offset;
        else
            ((uint64_t *)offsets)[count] = offset;
        if (!read_layout(reader, reader->row, rows + count * reader->row_width)) break;
    }
    *given = copy;
    return count;
}
