/*
 * What the generated lexer cannot recognise: nested comments, and the numbers of a table as one token.
 * The scanner keeps no state.
 */
#include "tree_sitter/parser.h"

enum TokenType { COMMENT, NUMERIC_TABLE, ERROR_SENTINEL };

static inline bool is_space(int32_t c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static inline bool is_digit(int32_t c) {
    return c >= '0' && c <= '9';
}

/* Passes a comment whose "/" is the next character; an unclosed one runs to the end. False: it is no comment. */
static bool scan_comment(TSLexer *lexer) {
    lexer->advance(lexer, false);
    if (lexer->lookahead != '*') return false;
    lexer->advance(lexer, false);
    for (uint32_t depth = 1; depth > 0 && !lexer->eof(lexer);) {
        int32_t c = lexer->lookahead;
        lexer->advance(lexer, false);
        if (c == '*' && lexer->lookahead == '/') {
            lexer->advance(lexer, false);
            depth--;
        } else if (c == '/' && lexer->lookahead == '*') {
            lexer->advance(lexer, false);
            depth++;
        }
    }
    return true;
}

/*
 * The numbers of a table, up to the "}" (or the end of the text), when nothing else stands before it but punctuation,
 * white space and comments. The token ends after the last number or punctuation mark. Whether the numbers make rows,
 * and whether each is well formed, is for the reader of the table to say.
 */
static bool scan_numeric_table(TSLexer *lexer) {
    bool any_digit = false;
    int32_t before = 0;
    for (;;) {
        int32_t c = lexer->lookahead;
        if (is_digit(c)) {
            any_digit = true;
        } else if (c == 'e' || c == 'E') {
            if (!is_digit(before) && before != '.') return false;
        } else if (c == '.' || c == '-' || c == '+' || c == '<' || c == '>' || c == ',') {
        } else {
            if (before != 0) lexer->mark_end(lexer);
            while (is_space(lexer->lookahead)) lexer->advance(lexer, false);
            before = 0;
            c = lexer->lookahead;
            if (c == '}' || (c == 0 && lexer->eof(lexer))) return any_digit;
            if (c == '/') {
                if (!scan_comment(lexer)) return false;
                continue;
            }
            if (!is_digit(c) && c != '<' && c != '>' && c != ',' && c != '-' && c != '+' && c != '.') return false;
            continue;
        }
        before = c;
        lexer->advance(lexer, false);
    }
}

bool tree_sitter_m3d_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid_symbols) {
    (void)payload;
    while (is_space(lexer->lookahead)) lexer->advance(lexer, true);
    if (lexer->lookahead == '/') {
        lexer->result_symbol = COMMENT;
        return valid_symbols[COMMENT] && scan_comment(lexer);
    }
    if (valid_symbols[NUMERIC_TABLE] && !valid_symbols[ERROR_SENTINEL]) {
        lexer->result_symbol = NUMERIC_TABLE;
        return scan_numeric_table(lexer);
    }
    return false;
}

void *tree_sitter_m3d_external_scanner_create(void) {
    return NULL;
}

void tree_sitter_m3d_external_scanner_destroy(void *payload) {
    (void)payload;
}

unsigned tree_sitter_m3d_external_scanner_serialize(void *payload, char *buffer) {
    (void)payload;
    (void)buffer;
    return 0;
}

void tree_sitter_m3d_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
    (void)payload;
    (void)buffer;
    (void)length;
}
