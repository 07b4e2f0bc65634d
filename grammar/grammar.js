/**
 * The tree-sitter grammar of the Mirage3D scene language.
 *
 * It is strict about form and permissive about which keyword stands where: any member parses in any body, and the
 * compiler's check against language.toml says precisely what is misplaced. The keyword sets come from that table.
 * Only what stands at the top level of a file stands nowhere else: that is where the parser finds its way again after
 * a missing brace.
 */

/// <reference types="tree-sitter-cli/dsl" />
// @ts-check

import keywords from "./keywords.js";

/** One or more of a rule, separated by commas. */
const listed = (rule) => seq(rule, repeat(seq(",", rule)));

/** The keyword of a block, statement or table, one of a set. */
const keyword = (words) => field("keyword", choice(...words));

/** A block; one that is a variable type can also begin as a copy of a variable. */
const blockOf = ($, { blocks, types }) =>
  choice(
    seq(keyword(blocks), field("body", $.body)),
    seq(
      keyword(types),
      choice(field("body", $.body), seq(field("name", $.identifier), optional(field("body", $.body)))),
    ),
  );

export default grammar({
  name: "m3d",

  externals: ($) => [
    $.comment,
    $.numeric_table,
    $._error_sentinel, // never produced: it is valid only while the parser recovers from an error
  ],

  extras: ($) => [/[ \t\r\n\f\v]/, $.comment],

  word: ($) => $.identifier,

  reserved: {
    global: ($) => keywords.all,
  },

  // After `KEYWORD name` the next token tells an argument from the target of an assignment.
  conflicts: ($) => [[$.statement]],

  rules: {
    source_file: ($) => repeat($._item),

    _item: ($) => choice($.variables, $.assignment, alias($.object, $.block), $._member),

    _member: ($) => choice($.block, $.statement, $.table),

    variables: ($) => seq(field("keyword", "VARIABLES"), "{", repeat($.declaration), "}"),

    declaration: ($) =>
      seq(field("type", choice(...keywords.all, $.identifier)), listed(field("name", $.identifier)), ";"),

    assignment: ($) =>
      seq(
        field("target", $.identifier),
        "=",
        choice(
          field("value", choice($.number, $.vector, $.identifier)),
          seq(optional(field("source", $.identifier)), field("body", $.body)),
        ),
      ),

    object: ($) => blockOf($, keywords.top),

    block: ($) => blockOf($, keywords.inner),

    body: ($) => seq("{", repeat($._member), "}"),

    statement: ($) => seq(keyword(keywords.statements), optional(listed(field("argument", $._value)))),

    table: ($) =>
      seq(
        keyword(keywords.tables),
        "{",
        choice(field("data", $.numeric_table), repeat(field("entry", $._value))),
        "}",
      ),

    _value: ($) => choice($.number, $.vector, $.identifier),

    vector: ($) => seq("<", $._component, ",", $._component, ",", $._component, ">"),

    _component: ($) => field("component", choice($.number, $.identifier)),

    // As in C, a malformed numeral is one token too: the compiler says what is wrong with it.
    number: (_) => /[+-]?\.?[0-9]([eE][+-]|[A-Za-z0-9_.])*/,

    identifier: (_) => /[A-Za-z][A-Za-z0-9_]*/,
  },
});
