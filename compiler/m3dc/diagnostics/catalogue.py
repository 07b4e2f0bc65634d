"""Every diagnostic the compiler can give: its code, severity, headline, what it means, and an example with its mending.

The headline is the 1993 program's wording where it had one (thesis, Appendix B). `{}` is filled in by the place that
reports it; a headline that is nothing but `{}` comes with the statement, from the language table. `wrong` causes the
diagnostic and `right` does not: the tests compile both. `m3dc --explain CODE` and docs/diagnostics.md show all of it.
"""

from typing import Literal, NamedTuple

Severity = Literal["error", "warning", "hint"]


class Entry(NamedTuple):
    """What there is to know of one diagnostic. `code` is what a user calls it by, for good; code says its name here.

    `error`: no picture comes of it. `warning`: probably not what was meant. `hint`: shown only when asked for.
    """

    code: str
    severity: Severity
    headline: str
    says: str
    wrong: str
    right: str


def _error(code: str, headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry(code, "error", headline, says, wrong, right)


def _warning(code: str, headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry(code, "warning", headline, says, wrong, right)


def _hint(code: str, headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry(code, "hint", headline, says, wrong, right)


_TRIANGLE = "VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> }"
_LIT = "SCENE { SKY { } }"


# --- what the text is made of -----------------------------------------------------------------------------------

MISSING_MARK = _error(
    "M3D0101",
    "Expecting a '{}'",
    "A brace, comma, semicolon, equals sign or closing angle bracket is missing. For a brace that is missing at the "
    "end of a block the block that is still open is named.",
    "SOLID { SPHERE { CENTER < 1 2, 3 > } }",
    "SOLID { SPHERE { CENTER < 1, 2, 3 > } }",
)
EXPECTED_VECTOR = _error(
    "M3D0102",
    "Expecting a vector constant or variable",
    "The statement takes a vector: three numbers < x, y, z >, or the name of a VECTOR variable.",
    "SOLID { SPHERE { CENTER 5 } }",
    "SOLID { SPHERE { CENTER < 5, 0, 0 > } }",
)
EXPECTED_NUMBER = _error(
    "M3D0103",
    "Expecting a numeric constant or variable",
    "The statement takes a number, or the name of a NUMBER variable. There are no arithmetic expressions.",
    "SOLID { SPHERE { RADIUS < 1, 2, 3 > } }",
    "SOLID { SPHERE { RADIUS 1 } }",
)
EXPECTED_DIGIT = _error(
    "M3D0104",
    "Expecting a digit",
    "A number has a digit on both sides of its point and at least one in its exponent, and is followed by a space.",
    "SOLID { SPHERE { RADIUS 2. } }",
    "SOLID { SPHERE { RADIUS 2.0 } }",
)
UNBALANCED_COMMENT = _error(
    "M3D0105",
    "Unbalanced Comment",
    "Comments nest: every /* needs its own */, and every */ a /* before it.",
    "/* outer /* inner */ SOLID { SPHERE { } }",
    "/* outer /* inner */ */ SOLID { SPHERE { } }",
)
INVALID_IN_BLOCK = _error(
    "M3D0106",
    "Invalid {} statement",
    "The word is no statement of this block. It may be misspelt, stand in the wrong block, or a brace may be missing "
    "before it. Keywords are in capitals.",
    "SOLID { SPHERE { RADUIS 2 } }",
    "SOLID { SPHERE { RADIUS 2 } }",
)
INVALID_AT_TOP = _error(
    "M3D0107",
    "Invalid statement",
    "At the top level of a file stand VARIABLES, SCENE, SOLID and LIGHT blocks, and assignments to variables.",
    "SPHERE { RADIUS 2 }",
    "SOLID { SPHERE { RADIUS 2 } }",
)
INVALID_NAME = _error(
    "M3D0108",
    "Invalid identifier",
    "A name starts with a letter, goes on with letters, digits and underscores, and is not a reserved word.",
    "VARIABLES { NUMBER 2nd; }",
    "VARIABLES { NUMBER second; }",
)
INVALID_TYPE = _error(
    "M3D0109",
    "Invalid type specification",
    "A declaration begins with one of the twelve types: NUMBER, VECTOR, SPHERE, PLANE, TRIANGLE, RECTANGLE, POLYGONS, "
    "SURFACE, SOURCE, TRANSFORM, SOLID, LIGHT.",
    "VARIABLES { TERRAIN hills; }",
    "VARIABLES { POLYGONS hills; }",
)
NAME_TOO_LONG = _error(
    "M3D0110",
    "Identifier name too long",
    "A name has at most 256 characters.",
    "VARIABLES { NUMBER " + "x" * 257 + "; }",
    "VARIABLES { NUMBER x; }",
)
NESTED_TOO_DEEPLY = _error(
    "M3D0111",
    "Blocks nested too deeply",
    "No scene needs blocks this deep; a closing brace is probably missing far above.",
    "SOLID { " + "SPHERE { " * 42 + "} " * 43,
    "SOLID { SPHERE { } }",
)
EMPTY_FILE = _error(
    "M3D0112",
    "Empty data file",
    "There is nothing but white space and comments.",
    "/* to be written */",
    "SOLID { SPHERE { } }",
)
NOT_A_TEXT_FILE = _error(
    "M3D0113",
    "Not a text file",
    "The file holds bytes that no text has. It may be a picture, a compiled scene, or a text in UTF-16: save it as "
    "UTF-8.",
    "SOLID { \x00 }",
    "SOLID { SPHERE { } }",
)
NUMBER_TOO_LARGE = _error(
    "M3D0114",
    "Number too large",
    "A number is at most about 1.8e308, a whole number at most 2147483647.",
    "SOLID { SPHERE { RADIUS 1e400 } }",
    "SOLID { SPHERE { RADIUS 1e4 } }",
)
TOO_MANY_ERRORS = _error(
    "M3D0115",
    "Too many errors",
    "The compiler gives up after 200 syntax errors or 10000 other problems, and where it can understand so little of a "
    "long text that reading on would take too long: the file is probably no scene.",
    "SOLID { SPHERE { RADIUS -1 } }\n" * 10_001,
    "SOLID { SPHERE { RADIUS 1 } }",
)
NOT_A_COMMENT = _error(
    "M3D0116",
    "Not a comment",
    "A comment stands between /* and */, and comments nest. There are none that end with the line.",
    "SOLID { SPHERE { } } // a ball",
    "SOLID { SPHERE { } } /* a ball */",
)
SUPERFLUOUS = _error(
    "M3D0117",
    "Superfluous {}",
    "A keyword is followed by its value, and a statement by the next one, with nothing between them. Only declarations "
    "end with a semicolon, and only assignments have an equals sign.",
    "SOLID { SPHERE { RADIUS = 2; } };",
    "SOLID { SPHERE { RADIUS 2 } }",
)
NO_EXPRESSIONS = _error(
    "M3D0118",
    "There are no expressions",
    "Nothing is calculated in a scene: a number is a numeral or the name of a NUMBER variable. A sign belongs to a "
    "numeral and stands right before it.",
    "SOLID { SPHERE { RADIUS 2 * 3 } }",
    "SOLID { SPHERE { RADIUS 6 } }",
)
INVISIBLE_CHARACTER = _error(
    "M3D0119",
    "Invisible character",
    "A character looks like a blank, or like nothing, and is none: a no-break space or a zero-width space, as word "
    "processors and web pages have them.",
    "SOLID { SPHERE {\u00a0RADIUS 2 } }",
    "SOLID { SPHERE { RADIUS 2 } }",
)
IDLE_DIRECTIVE = _warning(
    "M3D0120",
    "Directive without effect",
    "A comment `/* m3d: allow CODE, CODE */` keeps warnings and hints back, by their codes. Errors can not be kept back.",
    f"{_LIT} SOLID {{ SPHERE {{ }} }} /* m3d: alow M3D0512 */",
    f"{_LIT} SOLID {{ SPHERE {{ }} }} /* m3d: allow M3D0512 */",
)

# --- names ------------------------------------------------------------------------------------------------------

VARIABLE_ALREADY_DEFINED = _error(
    "M3D0201",
    "Variable already defined",
    "A name is declared once, whatever its type.",
    "VARIABLES { NUMBER a; VECTOR a; }",
    "VARIABLES { NUMBER a; VECTOR b; }",
)
UNDEFINED_NAME = _error(
    "M3D0202",
    "Undefined identifier",
    "A name is declared in the VARIABLES block, and that block stands before the name's first use.",
    "SOLID { SPHERE { RADIUS size } }",
    "VARIABLES { NUMBER size; } size = 2 SOLID { SPHERE { RADIUS size } }",
)
INCOMPATIBLE_TYPES = _error(
    "M3D0203",
    "Incompatible types",
    "A variable can stand only where its type is expected.",
    "VARIABLES { VECTOR size; } size = < 1, 2, 3 > SOLID { SPHERE { RADIUS size } }",
    "VARIABLES { NUMBER size; } size = 2 SOLID { SPHERE { RADIUS size } }",
)
ASSIGNED_TO_ITSELF = _error(
    "M3D0204",
    "Can not assign a variable to itself",
    "It already has its own value. To change a structure in place, assign it a block alone.",
    "VARIABLES { SPHERE ball; } ball = ball { RADIUS 2 }",
    "VARIABLES { SPHERE ball; } ball = { RADIUS 2 }",
)

# --- what may stand only once, and what must stand -----------------------------------------------------------------

BLOCK_ALREADY_DEFINED = _error(
    "M3D0301",
    "{}",
    "A file has one SCENE and one VARIABLES block, a SCENE one SKY and one MIRAGE.",
    "SCENE { SKY { } SKY { OVERCAST 1 } }",
    "SCENE { SKY { OVERCAST 1 } }",
)
NO_PROFILE = _error(
    "M3D0302",
    "No PROFILE specified",
    "A mirage is made by temperatures: a MIRAGE block needs a PROFILE.",
    "SCENE { MIRAGE { DISTANCE 5000 } }",
    "SCENE { MIRAGE { DISTANCE 5000 PROFILE { 0 10 5 11 20 12 } } }",
)
TABLE_ALREADY_DEFINED = _error(
    "M3D0303",
    "{} already defined",
    "A POLYGONS primitive has one VERTICES table and one FACETS or SFACETS table; a copied variable may have brought "
    "them along.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} FACETS {{ 1 2 1 0 }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 2 1 0 }} }} }}",
)
NO_TABLE = _error(
    "M3D0304",
    "No {} defined",
    "POLYGONS needs a VERTICES table and a FACETS or SFACETS table, TERRAIN a VERTICES table.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
UNDEFINED_VERTEX = _error(
    "M3D0305",
    "Vertex not defined",
    "A facet names a vertex that is not listed. Vertices are numbered from 0.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 1 2 3 }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
NO_PRIMITIVES = _error(
    "M3D0306",
    "Adding Solid object with no primitives",
    "A solid that is added to the scene has at least one primitive.",
    "SOLID { SURFACE { COLOR < 1, 0, 0 > } }",
    "SOLID { SPHERE { } SURFACE { COLOR < 1, 0, 0 > } }",
)
TOO_MANY_TRANSFORMATIONS = _error(
    "M3D0307",
    "Transform stack overflow",
    "A TRANSFORM block has at most 20 transformations. Put the rest into another one: it builds on the first.",
    "SOLID { SPHERE { TRANSFORM { " + "TRANSX 1 " * 21 + "} } }",
    "SOLID { SPHERE { TRANSFORM { " + "TRANSX 1 " * 20 + "} TRANSFORM { TRANSX 1 } } }",
)

# --- values -----------------------------------------------------------------------------------------------------

OUT_OF_RANGE = _error(
    "M3D0401",
    "{}",
    "The number is out of the range that the statement takes; the headline says which.",
    "SOLID { SPHERE { RADIUS -5.8 } }",
    "SOLID { SPHERE { RADIUS 5.8 } }",
)
SET_TO_DEFAULT = _warning(
    "M3D0402",
    "{}",
    "The number is out of range, and the statement's default takes its place.",
    "SCENE { SKY { } DEPTH 0 }",
    "SCENE { SKY { } DEPTH 1 }",
)
INVALID_VERTICES = _error(
    "M3D0403",
    "Invalid vertices",
    "Three points make a plane, a triangle, a rectangle or a facet only if they differ and do not lie on one line.",
    "SOLID { TRIANGLE { VERTEX1 < 1, 0, 0 > VERTEX2 < 2, 0, 0 > VERTEX3 < 3, 0, 0 > } }",
    "SOLID { TRIANGLE { VERTEX1 < 1, 1, 0 > VERTEX2 < 2, 0, 0 > VERTEX3 < 3, 0, 0 > } }",
)
ZERO_NORMAL = _error(
    "M3D0404",
    "Invalid Normal",
    "A normal is a vector of any length but zero.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,0> }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
)
MORE_ROWS_THAN_SPECIFIED = _error(
    "M3D0405",
    "Number of {} greater than specified",
    "A table begins with the number of its rows; there are more.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 2 1 0 }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 2 1 0 }} }} }}",
)
FEWER_ROWS_THAN_SPECIFIED = _error(
    "M3D0406",
    "Number of {} less than specified",
    "A table begins with the number of its rows; there are fewer.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
TOO_FEW_VERTICES = _error(
    "M3D0407",
    "Argument must be > 2",
    "POLYGONS needs at least three vertices.",
    "SOLID { POLYGONS { VERTICES { 2 <0,0,0> <1,0,0> } FACETS { 1 0 1 0 } } }",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
TOO_FEW_ROWS = _error(
    "M3D0408",
    "Argument too small",
    "POLYGONS needs at least one facet, TERRAIN at least two rows and two columns.",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 0 }} }} }}",
    f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
OVERLAPPING_CELLS = _error(
    "M3D0409",
    "Overlapping terrain cells",
    "Seen along the grid's axis no cell of a TERRAIN may fold over another: positions go on in one direction along "
    "each row and column.",
    "SOLID { TERRAIN { VERTICES { 2 2 <0,0,0> <1,1,0> <1,0,0> <0,1,0> } } }",
    "SOLID { TERRAIN { VERTICES { 2 2 <0,0,0> <0,1,0> <1,0,0> <1,1,0> } } }",
)
TOO_FEW_PROFILE_POINTS = _error(
    "M3D0410",
    "Need at least 3 PROFILE points",
    "A temperature profile has 3 to 200 points.",
    "SCENE { MIRAGE { PROFILE { 0 10 20 12 } } }",
    "SCENE { MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
)
PROFILE_NOT_INCREASING = _error(
    "M3D0411",
    "PROFILE elevations must be increasing",
    "The points of a temperature profile are listed from low to high. There is no restriction on temperatures.",
    "SCENE { MIRAGE { PROFILE { 0 10 20 12 5 11 } } }",
    "SCENE { MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
)
TOO_MANY = _error(
    "M3D0412",
    "Too many {}",
    "A temperature profile has at most 200 points, a texture at most 20 colour ranges. A scene has at most 2 million "
    "solids, primitives and textures, and 20 million vertices and facets, each copy counted.",
    "SCENE { MIRAGE { PROFILE { " + " ".join(f"{i / 10:.1f} 10" for i in range(201)) + " } } }",
    "SCENE { MIRAGE { PROFILE { " + " ".join(f"{i / 10:.1f} 10" for i in range(200)) + " } } }",
)
COLOR_RANGES_NOT_INCREASING = _error(
    "M3D0413",
    "Second index must be greater than first",
    "Colour ranges run upwards between 0 and 1 and do not overlap: u < v, and u is not below the v before.",
    "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { 0.5 0.2 <1,0,0> <0,1,0> } } } } }",
    "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { 0.2 0.5 <1,0,0> <0,1,0> } } } } }",
)
SUN_BELOW_HORIZON = _error(
    "M3D0414",
    "Sun must be above the horizon",
    "Sunlight travels downwards: the z component of its direction is negative.",
    "SCENE { SKY { SUN { DIRECTION < 1, 0, 0.5 > } } }",
    "SCENE { SKY { SUN { DIRECTION < 1, 0, -0.5 > } } }",
)
FROM_EQUALS_TO = _error(
    "M3D0415",
    "Distance between FROM and TO is too small",
    "Two points give a direction only if they differ.",
    "SCENE { VIEW { FROM < 1, 2, 3 > TO < 1, 2, 3 > } }",
    "SCENE { VIEW { FROM < 1, 2, 3 > TO < 0, 2, 3 > } }",
)
REGION_BOTTOM_ABOVE_TOP = _warning(
    "M3D0416",
    "REGION bottom must be >= top",
    "The bottom of the region is set to its top: one row of pixels is left.",
    "SCENE { SKY { } VIEW { REGION 20, 0, 10, 99 } }",
    "SCENE { SKY { } VIEW { REGION 10, 0, 20, 99 } }",
)
REGION_RIGHT_BEFORE_LEFT = _warning(
    "M3D0417",
    "REGION right must be >= left",
    "The right of the region is set to its left: one column of pixels is left. The order is top, left, bottom, right.",
    "SCENE { SKY { } VIEW { REGION 0, 99, 20, 10 } }",
    "SCENE { SKY { } VIEW { REGION 0, 10, 20, 99 } }",
)
EYE_BELOW_PROFILE = _error(
    "M3D0418",
    "Observer position below all temperature layers",
    "With a mirage the eye, VIEW's FROM, must stand between the lowest and the highest elevation of the PROFILE.",
    "SCENE { VIEW { FROM < 20, 0, -1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    "SCENE { VIEW { FROM < 20, 0, 1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
)
EYE_ABOVE_PROFILE = _error(
    "M3D0419",
    "Observer position above all temperature layers",
    "With a mirage the eye, VIEW's FROM, must stand between the lowest and the highest elevation of the PROFILE.",
    "SCENE { VIEW { FROM < 20, 0, 30 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    "SCENE { VIEW { FROM < 20, 0, 19 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
)
ZERO_DIRECTION = _error(
    "M3D0420",
    "Direction must not be zero",
    "A direction is a vector of any length but zero.",
    "LIGHT { SOURCE { DIRECTION < 0, 0, 0 > } }",
    "LIGHT { SOURCE { DIRECTION < 0, 0, -1 > } }",
)
NO_INVERSE = _error(
    "M3D0421",
    "Transform can not be inverted",
    "A transformation's numbers are so large or small that it can not be undone, which texturing needs.",
    "SOLID { SPHERE { TRANSFORM { SCALEX 1e-320 } } }",
    "SOLID { SPHERE { TRANSFORM { SCALEX 1e-3 } } }",
)
SET_TO_LIMIT = _warning(
    "M3D0422",
    "{}",
    "The number is out of range, and the nearest limit takes its place.",
    "SCENE { SKY { OVERCAST 1.5 } }",
    "SCENE { SKY { OVERCAST 1 } }",
)
UNUSUAL_NUMBER = _warning(
    "M3D0423",
    "{}",
    "The number is out of the range it should be in, and is used all the same.",
    "SCENE { SKY { INTENSITY 1.5 } }",
    "SCENE { SKY { INTENSITY 1 } }",
)
TOO_FAR = _error(
    "M3D0424",
    "Nothing may reach farther than 1e30",
    "Once everything is transformed, no coordinate in the world is beyond 1e30, up to which pictures are exact. What "
    "a scene writes down is within 1e20 in itself; a scale factor that is meant to be much smaller carries it farther.",
    "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e140 } } }",
    "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e4 } } }",
)

# --- probably not what was meant ------------------------------------------------------------------------------------

TRANSFORM_DISCARDS = _warning(
    "M3D0501",
    "TRANSFORM discards the transformations before it",
    "`TRANSFORM name` replaces the matrix. To build on it, put the name first and the blocks after it.",
    "VARIABLES { TRANSFORM turn; } turn = { ROTZ 30 } "
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ TRANSX 5 }} TRANSFORM turn }} }}",
    "VARIABLES { TRANSFORM turn; } turn = { ROTZ 30 } "
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM turn TRANSFORM {{ TRANSX 5 }} }} }}",
)
IDENTITY_DISCARDS = _warning(
    "M3D0502",
    "IDENTITY discards the transformations before it",
    "IDENTITY clears the matrix; what stands before it in the block has no effect.",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ TRANSX 5 IDENTITY ROTZ 30 }} }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ IDENTITY ROTZ 30 }} }} }}",
)
UNUSED_VARIABLE = _warning(
    "M3D0503",
    "Unused variable",
    "The variable is never used. Variables do not become part of a scene by themselves.",
    f"VARIABLES {{ NUMBER size; }} size = 2 {_LIT} SOLID {{ SPHERE {{ }} }}",
    f"VARIABLES {{ NUMBER size; }} size = 2 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
)
UNASSIGNED_VARIABLE = _warning(
    "M3D0504",
    "Variable used before it is assigned",
    "At its use the variable still has its default value: 0 for a number, the statements' defaults for a structure.",
    f"VARIABLES {{ SPHERE ball; }} {_LIT} SOLID {{ SPHERE ball }} ball = {{ RADIUS 2 }}",
    f"VARIABLES {{ SPHERE ball; }} {_LIT} ball = {{ RADIUS 2 }} SOLID {{ SPHERE ball }}",
)
LIGHT_REACHES_NOTHING = _warning(
    "M3D0505",
    "Light reaches nothing",
    "The light is black, has no intensity, or shines past everything in the scene.",
    "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 9, 0, 0 > TO < 20, 0, 0 > ANGLE 30 } }",
    "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 9, 0, 0 > TO < 0, 0, 0 > ANGLE 30 } }",
)
EYE_ON_LAYER_BOUNDARY = _warning(
    "M3D0506",
    "Observer stands on a layer boundary",
    "The eye is within a tenth of a millimetre of a point of the PROFILE, where the curvature of rays changes at once. "
    "If the layer below bends rays down and the layer above bends them up, rays just below and just above the "
    "horizontal go different ways, and the picture has a gap at the height of the eye.",
    "SCENE { SKY { } VIEW { FROM < 20, 0, 5 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    "SCENE { SKY { } VIEW { FROM < 20, 0, 5.1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
)
TEXTURE_STAYS = _hint(
    "M3D0507",
    "Texture stays in place when its object moves",
    "The object is transformed and its texture is not LOCAL, so the pattern is that of the scene at the object's new "
    "place. That may be what is wanted.",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ WOOD {{ }} }} }} TRANSFORM {{ TRANSX 5 }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ WOOD {{ LOCAL }} }} }} TRANSFORM {{ TRANSX 5 }} }}",
)
TOO_MANY_SEGMENTS = _warning(
    "M3D0508",
    "A curved ray has 1000000 arcs at most",
    "SEGMENTS beyond that has no effect: memory and time for a ray are bounded. A ray through the air of a whole day's "
    "sight has a few thousand.",
    "SCENE { SKY { } MIRAGE { SEGMENTS 2000000 PROFILE { 0 10 5 11 20 12 } } }",
    "SCENE { SKY { } MIRAGE { SEGMENTS 1000000 PROFILE { 0 10 5 11 20 12 } } }",
)
STRETCHED_SPHERE = _warning(
    "M3D0509",
    "A scaled sphere stays a sphere",
    "The transformation scales differently in different directions, but a sphere only grows, by the largest factor.",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ SCALE < 1, 1, 3 > }} }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ SCALE < 3, 3, 3 > }} }} }}",
)
UNUSED_VERTICES = _warning(
    "M3D0510",
    "Vertices that no facet uses",
    "They have no effect but on the scene's extents.",
    f"{_LIT} SOLID {{ POLYGONS {{ VERTICES {{ 4 <0,0,0> <1,0,0> <0,1,0> <5,5,5> }} FACETS {{ 1 0 1 2 }} }} }}",
    f"{_LIT} SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
)
NORMAL_ON_WRONG_SIDE = _warning(
    "M3D0511",
    "Normal on wrong side of facet",
    "With PHONG a corner's normal must point to the side from which the facet's corners run counter-clockwise; "
    "otherwise there is a black hole.",
    f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,-1> }} }} }}",
    f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
)
OVERWRITTEN = _warning(
    "M3D0512",
    "Only the last {} counts",
    "The same statement stands twice in one block; each overwrites the one before it. So does a SURFACE or SOURCE that "
    "is a copy of a variable.",
    f"{_LIT} SOLID {{ SPHERE {{ RADIUS 2 RADIUS 3 }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ RADIUS 3 }} }}",
)
NO_LIGHT = _warning(
    "M3D0513",
    "Scene without light",
    "There is neither a LIGHT nor a SKY: solids show by ambient light alone, nearly black.",
    "SOLID { SPHERE { } }",
    "SOLID { SPHERE { } } SCENE { SKY { } }",
)

# --- without effect, or in another unit ---------------------------------------------------------------------------

PHONG_WITHOUT_NORMALS = _warning(
    "M3D0514",
    "PHONG has no effect without SFACETS",
    "PHONG interpolates the normals at the corners of facets. FACETS gives none; SFACETS does.",
    f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
)
IDLE_IN_LIGHT = _warning(
    "M3D0515",
    "{} has no effect on this light",
    "ANGLE, EXPONENT and ATTENUATION are about a POINT light. Its DIRECTION, ZENITH and AZIMUTH count only where ANGLE "
    "or EXPONENT narrow it: where it stands is its FROM.",
    "SOLID { SPHERE { } } LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 0, 0, 0 > ANGLE 20 } }",
    "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 0, 0, 9 > TO < 0, 0, 0 > ANGLE 20 } }",
)
NO_WAVE = _warning(
    "M3D0516",
    "{} has no effect without a WAVE",
    "WAVES and RIPPLES are the sum of the sources of waves that stand in them; there is none by itself.",
    f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ WAVES {{ }} }} }} }}",
    f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ WAVES {{ WAVE {{ FREQ 2 }} }} }} }} }}",
)
IDLE_IN_TEXTURE = _warning(
    "M3D0517",
    "{} has no effect in this texture",
    "Every texture can be given every statement, but each kind uses only some of them. With COLORS, COLOR is not used.",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ CHECKER {{ TURBULENCE 2 }} }} }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ MARBLE {{ TURBULENCE 2 }} }} }} }}",
)
BLEND_ON_PLANE = _warning(
    "M3D0518",
    "{} has no effect on a PLANE",
    "UBLEND and VBLEND change a colour from one side of a primitive to the other. A PLANE has no sides.",
    f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ UBLEND {{ COLOR < 0, 0, 1 > }} }} }} }}",
    f"{_LIT} SOLID {{ RECTANGLE {{ }} SURFACE {{ TEXTURE {{ UBLEND {{ COLOR < 0, 0, 1 > }} }} }} }}",
)
BACKGROUND_NEVER_SEEN = _warning(
    "M3D0519",
    "BACKGROUND is never seen",
    "Where a ray meets nothing the SKY is seen; without one, the HAZE; without either, the BACKGROUND.",
    "SCENE { BACKGROUND < 0, 0, 0.5 > SKY { } }",
    "SCENE { SKY { ZENITHCOLOR < 0, 0, 0.5 > } }",
)
AMBIENT_NOT_SAMPLED = _warning(
    "M3D0520",
    "Ambient light is not sampled",
    "Light from around is sampled with both: NSAMPLES, the number of rays from each surface, and a DEPTH of 2 or more. "
    "Otherwise it is constant.",
    "SOLID { SPHERE { } } SCENE { SKY { } AMBIENT { NSAMPLES 8 } }",
    "SOLID { SPHERE { } } SCENE { SKY { } AMBIENT { NSAMPLES 8 DEPTH 2 } }",
)
NOSHADOWS_WITHOUT_SHADOWS = _hint(
    "M3D0521",
    "NOSHADOWS has no effect without SHADOWS",
    "Lights cast shadows only if the SCENE says SHADOWS, or a renderer is asked for them.",
    "SOLID { SPHERE { } } SCENE { SKY { SUN { NOSHADOWS } } }",
    "SOLID { SPHERE { } } SCENE { SHADOWS SKY { SUN { NOSHADOWS } } }",
)
IDLE_IN_SURFACE = _warning(
    "M3D0522",
    "{} has no effect on this surface",
    "HARD and METALLIC are about light that is reflected specularly, and need a SPECULAR above 0.",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ SPECULAR 0 HARD 0.9 }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ SPECULAR 0.5 HARD 0.9 }} }}",
)
CHANGES_THE_ONE_BEFORE = _hint(
    "M3D0523",
    "This {} changes the one before it",
    "A second SURFACE or SOURCE in braces does not take the place of the first: it changes what it names and keeps the "
    "rest.",
    f"VARIABLES {{ SURFACE matt; }} matt = {{ ROUGH 1 }} {_LIT} SOLID {{ SPHERE {{ }} SURFACE matt SURFACE {{ SPECULAR 0 }} }}",
    f"VARIABLES {{ SURFACE matt; }} matt = {{ ROUGH 1 }} {_LIT} SOLID {{ SPHERE {{ }} SURFACE matt {{ SPECULAR 0 }} }}",
)
UNUSED_VALUE = _warning(
    "M3D0524",
    "Value is never used",
    "A variable is given another value before anything uses this one, or is not used any more. An assignment counts "
    "from its place in the file on.",
    f"VARIABLES {{ NUMBER size; }} size = 2 size = 3 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
    f"VARIABLES {{ NUMBER size; }} size = 3 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
)
PROFILE_IN_KELVIN = _warning(
    "M3D0525",
    "Temperatures look like kelvin",
    "The temperatures of a PROFILE are in degrees Celsius. No air is as hot as these.",
    "SCENE { SKY { } MIRAGE { PROFILE { 0 283 5 284 20 285 } } }",
    "SCENE { SKY { } MIRAGE { PROFILE { 0 9.85 5 10.85 20 11.85 } } }",
)
NOTHING_IN_VIEW = _warning(
    "M3D0526",
    "Nothing stands before the camera",
    "Every solid and every visible light is behind the eye, or beside what it sees. VIEW's FROM is where the eye is, TO "
    "what it looks at, FOV how wide.",
    "SOLID { SPHERE { CENTER < 90, 0, 6 > } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
    "SOLID { SPHERE { CENTER < 90, 0, 6 > } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 90, 0, 6 > } }",
)
EYE_IN_SPHERE = _warning(
    "M3D0527",
    "Camera inside a SPHERE",
    "The eye is in a sphere that nothing else reaches into and no light stands in: only its inside is seen.",
    "SOLID { SPHERE { CENTER < 20, 0, 6 > RADIUS 2 } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
    "SOLID { SPHERE { CENTER < 0, 0, 6 > RADIUS 2 } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
)
ANGLE_IN_RADIANS = _hint(
    "M3D0528",
    "Angle looks like radians",
    "Angles are in degrees. These are: a common part of a turn as it is in radians, such as 1.57; or rotations of a "
    "scene that has none of more than 6.28 degrees, if not all are whole numbers.",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ ROTZ 1.57 }} }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ ROTZ 90 }} }} }}",
)
HEIGHTS_OF_PLANES = _warning(
    "M3D0529",
    "{} has no effect in a scene of planes",
    "SNOW and GRADIENT go by the heights of the scene, from its lowest to its highest point, in which planes do not "
    "count: they have no end.",
    f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ SNOW {{ ELEVATION 0.5 }} }} }} }}",
    f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ SNOW {{ ELEVATION 0 }} }} }} }} SOLID {{ SPHERE {{ }} }}",
)
COLOR_OF_BYTES = _warning(
    "M3D0530",
    "{}",
    "The components of a colour go from 0 to 1, and these seem to go from 0 to 255: divide them by 255. What is above 1 "
    "counts as 1.",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ COLOR < 255, 128, 0 > }} }}",
    f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ COLOR < 1, 0.502, 0 > }} }}",
)

CATALOGUE: dict[str, Entry] = {entry.code: entry for entry in tuple(globals().values()) if isinstance(entry, Entry)}
"""All of them by code, in order."""
