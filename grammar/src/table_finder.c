#include "table_finder.h"

#include <string.h>

#define LONGEST_KEYWORD 30

enum { OTHER, BLANK, WORD, DIGIT, MARK };

/* What a byte is: for the tables' numbers a letter is none but E, which is looked at by itself. */
static const uint8_t kinds[256] = {
    ['\t'] = BLANK, ['\n'] = BLANK, ['\v'] = BLANK, ['\f'] = BLANK, ['\r'] = BLANK, [' '] = BLANK,
    ['0'] = DIGIT,  ['1'] = DIGIT,  ['2'] = DIGIT,  ['3'] = DIGIT,  ['4'] = DIGIT,
    ['5'] = DIGIT,  ['6'] = DIGIT,  ['7'] = DIGIT,  ['8'] = DIGIT,  ['9'] = DIGIT,
    ['+'] = MARK,   ['-'] = MARK,   ['<'] = MARK,   ['>'] = MARK,   [','] = MARK,   ['.'] = MARK,
};

static inline bool is_letter(uint8_t c) {
    return (uint8_t)((c | 0x20) - 'a') < 26;
}

static inline bool is_part_of_word(uint8_t c) {
    return is_letter(c) || kinds[c] == DIGIT || c == '_' || c == '.';
}

static inline bool opens_comment(const uint8_t *p, const uint8_t *end) {
    return end - p >= 2 && p[0] == '/' && p[1] == '*';
}

/* Past a comment; NULL when it is not closed. */
static const uint8_t *skip_comment(const uint8_t *p, const uint8_t *end) {
    size_t depth = 0;
    while (end - p >= 2) {
        if (p[0] == '/' && p[1] == '*') {
            depth++;
            p += 2;
        } else if (p[0] == '*' && p[1] == '/') {
            p += 2;
            if (--depth == 0) return p;
        } else {
            p++;
        }
    }
    return NULL;
}

/* The "}" after a table's numbers; NULL where there is something else among them. */
static const uint8_t *end_of_numbers(const uint8_t *p, const uint8_t *end) {
    while (p < end) {
        if (kinds[*p] != OTHER) {
            p++;
        } else if ((*p == 'e' || *p == 'E') && (kinds[p[-1]] == DIGIT || p[-1] == '.')) {
            p++;
        } else if (*p == '}') {
            return p;
        } else if (!opens_comment(p, end) || !(p = skip_comment(p, end))) {
            return NULL;
        }
    }
    return NULL;
}

static bool is_keyword(const TableFinder *finder, const uint8_t *word, size_t length) {
    char spaced[LONGEST_KEYWORD + 3];
    if (length == 0 || length > LONGEST_KEYWORD) return false;
    spaced[0] = ' ';
    memcpy(spaced + 1, word, length);
    spaced[length + 1] = ' ';
    spaced[length + 2] = '\0';
    return strstr(finder->keywords, spaced) != NULL;
}

bool table_finder_next(TableFinder *finder, const uint8_t **start, const uint8_t **end) {
    const uint8_t *p = finder->at, *const stop = finder->end, *word = p;
    size_t length = 0; /* of the word before; 0 when something else came after it */
    while (p < stop) {
        if (is_part_of_word(*p)) {
            word = p;
            while (p < stop && is_part_of_word(*p)) p++;
            length = (size_t)(p - word);
        } else if (kinds[*p] == BLANK) {
            p++;
        } else if (opens_comment(p, stop)) {
            if (!(p = skip_comment(p, stop))) break;
        } else if (*p++ != '{' || !is_keyword(finder, word, length)) {
            length = 0;
        } else {
            const uint8_t *close = end_of_numbers(p, stop);
            length = 0;
            if (close && (size_t)(close - p) >= finder->least) {
                *start = p;
                *end = close;
                finder->at = close + 1;
                return true;
            }
            if (close) p = close + 1;
        }
    }
    finder->at = stop;
    return false;
}
