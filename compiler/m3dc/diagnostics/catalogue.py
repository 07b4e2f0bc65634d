"""Every diagnostic the compiler can give: its code, severity, headline, what it means, and an example with its mending.

The headline is the 1993 program's wording where it had one (thesis, Appendix B). `{}` is filled in by the place that
reports it; a headline that is nothing but `{}` comes with the statement, from the language table. `wrong` causes the
diagnostic and `right` does not: the tests compile both. `m3dc --explain CODE` and docs/diagnostics.md show all of it.
"""

from typing import Literal, NamedTuple

Severity = Literal["error", "warning", "hint"]


class Entry(NamedTuple):
    """`error`: no picture comes of it. `warning`: probably not what was meant. `hint`: shown only when asked for."""

    severity: Severity
    headline: str
    says: str
    wrong: str
    right: str


def _error(headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry("error", headline, says, wrong, right)


def _warning(headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry("warning", headline, says, wrong, right)


def _hint(headline: str, says: str, wrong: str, right: str) -> Entry:
    return Entry("hint", headline, says, wrong, right)


_TRIANGLE = "VERTICES { 3 <0,0,0> <1,0,0> <0,1,0> }"
_LIT = "SCENE { SKY { } }"

CATALOGUE: dict[str, Entry] = {
    # --- what the text is made of -----------------------------------------------------------------------------------
    "M3D0101": _error(
        "Expecting a '{}'",
        "A brace, comma, semicolon, equals sign or closing angle bracket is missing. For a brace that is missing at the "
        "end of a block the block that is still open is named.",
        "SOLID { SPHERE { CENTER < 1 2, 3 > } }",
        "SOLID { SPHERE { CENTER < 1, 2, 3 > } }",
    ),
    "M3D0102": _error(
        "Expecting a vector constant or variable",
        "The statement takes a vector: three numbers < x, y, z >, or the name of a VECTOR variable.",
        "SOLID { SPHERE { CENTER 5 } }",
        "SOLID { SPHERE { CENTER < 5, 0, 0 > } }",
    ),
    "M3D0103": _error(
        "Expecting a numeric constant or variable",
        "The statement takes a number, or the name of a NUMBER variable. There are no arithmetic expressions.",
        "SOLID { SPHERE { RADIUS < 1, 2, 3 > } }",
        "SOLID { SPHERE { RADIUS 1 } }",
    ),
    "M3D0104": _error(
        "Expecting a digit",
        "A number has a digit on both sides of its point and at least one in its exponent, and is followed by a space.",
        "SOLID { SPHERE { RADIUS 2. } }",
        "SOLID { SPHERE { RADIUS 2.0 } }",
    ),
    "M3D0105": _error(
        "Unbalanced Comment",
        "Comments nest: every /* needs its own */, and every */ a /* before it.",
        "/* outer /* inner */ SOLID { SPHERE { } }",
        "/* outer /* inner */ */ SOLID { SPHERE { } }",
    ),
    "M3D0106": _error(
        "Invalid {} statement",
        "The word is no statement of this block. It may be misspelt, stand in the wrong block, or a brace may be missing "
        "before it. Keywords are in capitals.",
        "SOLID { SPHERE { RADUIS 2 } }",
        "SOLID { SPHERE { RADIUS 2 } }",
    ),
    "M3D0107": _error(
        "Invalid statement",
        "At the top level of a file stand VARIABLES, SCENE, SOLID and LIGHT blocks, and assignments to variables.",
        "SPHERE { RADIUS 2 }",
        "SOLID { SPHERE { RADIUS 2 } }",
    ),
    "M3D0108": _error(
        "Invalid identifier",
        "A name starts with a letter, goes on with letters, digits and underscores, and is not a reserved word.",
        "VARIABLES { NUMBER 2nd; }",
        "VARIABLES { NUMBER second; }",
    ),
    "M3D0109": _error(
        "Invalid type specification",
        "A declaration begins with one of the twelve types: NUMBER, VECTOR, SPHERE, PLANE, TRIANGLE, RECTANGLE, POLYGONS, "
        "SURFACE, SOURCE, TRANSFORM, SOLID, LIGHT.",
        "VARIABLES { TERRAIN hills; }",
        "VARIABLES { POLYGONS hills; }",
    ),
    "M3D0110": _error(
        "Identifier name too long",
        "A name has at most 256 characters.",
        "VARIABLES { NUMBER " + "x" * 257 + "; }",
        "VARIABLES { NUMBER x; }",
    ),
    "M3D0111": _error(
        "Blocks nested too deeply",
        "No scene needs blocks this deep; a closing brace is probably missing far above.",
        "SOLID { " + "SPHERE { " * 42 + "} " * 43,
        "SOLID { SPHERE { } }",
    ),
    "M3D0112": _error(
        "Empty data file",
        "There is nothing but white space and comments.",
        "/* to be written */",
        "SOLID { SPHERE { } }",
    ),
    "M3D0113": _error(
        "Not a text file",
        "The file holds bytes that no text has. It may be a picture, a compiled scene, or a text in UTF-16: save it as "
        "UTF-8.",
        "SOLID { \x00 }",
        "SOLID { SPHERE { } }",
    ),
    "M3D0114": _error(
        "Number too large",
        "A number is at most about 1.8e308, a whole number at most 2147483647.",
        "SOLID { SPHERE { RADIUS 1e400 } }",
        "SOLID { SPHERE { RADIUS 1e4 } }",
    ),
    "M3D0115": _error(
        "Too many errors",
        "The compiler gives up after 200 syntax errors or 10000 other problems: the file is probably no scene.",
        "SOLID { SPHERE { RADIUS -1 } }\n" * 10_001,
        "SOLID { SPHERE { RADIUS 1 } }",
    ),
    "M3D0116": _error(
        "Not a comment",
        "A comment stands between /* and */, and comments nest. There are none that end with the line.",
        "SOLID { SPHERE { } } // a ball",
        "SOLID { SPHERE { } } /* a ball */",
    ),
    "M3D0117": _error(
        "Superfluous {}",
        "A keyword is followed by its value, and a statement by the next one, with nothing between them. Only declarations "
        "end with a semicolon, and only assignments have an equals sign.",
        "SOLID { SPHERE { RADIUS = 2; } };",
        "SOLID { SPHERE { RADIUS 2 } }",
    ),
    "M3D0118": _error(
        "There are no expressions",
        "Nothing is calculated in a scene: a number is a numeral or the name of a NUMBER variable. A sign belongs to a "
        "numeral and stands right before it.",
        "SOLID { SPHERE { RADIUS 2 * 3 } }",
        "SOLID { SPHERE { RADIUS 6 } }",
    ),
    "M3D0119": _error(
        "Invisible character",
        "A character looks like a blank, or like nothing, and is none: a no-break space or a zero-width space, as word "
        "processors and web pages have them.",
        "SOLID { SPHERE {\u00a0RADIUS 2 } }",
        "SOLID { SPHERE { RADIUS 2 } }",
    ),
    "M3D0120": _warning(
        "Directive without effect",
        "A comment `/* m3d: allow CODE, CODE */` keeps warnings and hints back, by their codes. Errors can not be kept back.",
        f"{_LIT} SOLID {{ SPHERE {{ }} }} /* m3d: alow M3D0512 */",
        f"{_LIT} SOLID {{ SPHERE {{ }} }} /* m3d: allow M3D0512 */",
    ),
    # --- names ------------------------------------------------------------------------------------------------------
    "M3D0201": _error(
        "Variable already defined",
        "A name is declared once, whatever its type.",
        "VARIABLES { NUMBER a; VECTOR a; }",
        "VARIABLES { NUMBER a; VECTOR b; }",
    ),
    "M3D0202": _error(
        "Undefined identifier",
        "A name is declared in the VARIABLES block, and that block stands before the name's first use.",
        "SOLID { SPHERE { RADIUS size } }",
        "VARIABLES { NUMBER size; } size = 2 SOLID { SPHERE { RADIUS size } }",
    ),
    "M3D0203": _error(
        "Incompatible types",
        "A variable can stand only where its type is expected.",
        "VARIABLES { VECTOR size; } size = < 1, 2, 3 > SOLID { SPHERE { RADIUS size } }",
        "VARIABLES { NUMBER size; } size = 2 SOLID { SPHERE { RADIUS size } }",
    ),
    "M3D0204": _error(
        "Can not assign a variable to itself",
        "It already has its own value. To change a structure in place, assign it a block alone.",
        "VARIABLES { SPHERE ball; } ball = ball { RADIUS 2 }",
        "VARIABLES { SPHERE ball; } ball = { RADIUS 2 }",
    ),
    # --- what may stand only once, and what must stand -----------------------------------------------------------------
    "M3D0301": _error(
        "{}",
        "A file has one SCENE and one VARIABLES block, a SCENE one SKY and one MIRAGE.",
        "SCENE { SKY { } SKY { OVERCAST 1 } }",
        "SCENE { SKY { OVERCAST 1 } }",
    ),
    "M3D0302": _error(
        "No PROFILE specified",
        "A mirage is made by temperatures: a MIRAGE block needs a PROFILE.",
        "SCENE { MIRAGE { DISTANCE 5000 } }",
        "SCENE { MIRAGE { DISTANCE 5000 PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0303": _error(
        "{} already defined",
        "A POLYGONS primitive has one VERTICES table and one FACETS or SFACETS table; a copied variable may have brought "
        "them along.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} FACETS {{ 1 2 1 0 }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 2 1 0 }} }} }}",
    ),
    "M3D0304": _error(
        "No {} defined",
        "POLYGONS needs a VERTICES table and a FACETS or SFACETS table, TERRAIN a VERTICES table.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0305": _error(
        "Vertex not defined",
        "A facet names a vertex that is not listed. Vertices are numbered from 0.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 1 2 3 }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0306": _error(
        "Adding Solid object with no primitives",
        "A solid that is added to the scene has at least one primitive.",
        "SOLID { SURFACE { COLOR < 1, 0, 0 > } }",
        "SOLID { SPHERE { } SURFACE { COLOR < 1, 0, 0 > } }",
    ),
    "M3D0307": _error(
        "Transform stack overflow",
        "A TRANSFORM block has at most 20 transformations. Put the rest into another one: it builds on the first.",
        "SOLID { SPHERE { TRANSFORM { " + "TRANSX 1 " * 21 + "} } }",
        "SOLID { SPHERE { TRANSFORM { " + "TRANSX 1 " * 20 + "} TRANSFORM { TRANSX 1 } } }",
    ),
    # --- values -----------------------------------------------------------------------------------------------------
    "M3D0401": _error(
        "{}",
        "The number is out of the range that the statement takes; the headline says which.",
        "SOLID { SPHERE { RADIUS -5.8 } }",
        "SOLID { SPHERE { RADIUS 5.8 } }",
    ),
    "M3D0402": _warning(
        "{}",
        "The number is out of range, and the statement's default takes its place.",
        "SCENE { SKY { } DEPTH 0 }",
        "SCENE { SKY { } DEPTH 1 }",
    ),
    "M3D0403": _error(
        "Invalid vertices",
        "Three points make a plane, a triangle, a rectangle or a facet only if they differ and do not lie on one line.",
        "SOLID { TRIANGLE { VERTEX1 < 1, 0, 0 > VERTEX2 < 2, 0, 0 > VERTEX3 < 3, 0, 0 > } }",
        "SOLID { TRIANGLE { VERTEX1 < 1, 1, 0 > VERTEX2 < 2, 0, 0 > VERTEX3 < 3, 0, 0 > } }",
    ),
    "M3D0404": _error(
        "Invalid Normal",
        "A normal is a vector of any length but zero.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,0> }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
    ),
    "M3D0405": _error(
        "Number of {} greater than specified",
        "A table begins with the number of its rows; there are more.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 2 1 0 }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 2 1 0 }} }} }}",
    ),
    "M3D0406": _error(
        "Number of {} less than specified",
        "A table begins with the number of its rows; there are fewer.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 2 0 1 2 }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0407": _error(
        "Argument must be > 2",
        "POLYGONS needs at least three vertices.",
        "SOLID { POLYGONS { VERTICES { 2 <0,0,0> <1,0,0> } FACETS { 1 0 1 0 } } }",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0408": _error(
        "Argument too small",
        "POLYGONS needs at least one facet, TERRAIN at least two rows and two columns.",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 0 }} }} }}",
        f"SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0409": _error(
        "Overlapping terrain cells",
        "Seen along the grid's axis no cell of a TERRAIN may fold over another: positions go on in one direction along "
        "each row and column.",
        "SOLID { TERRAIN { VERTICES { 2 2 <0,0,0> <1,1,0> <1,0,0> <0,1,0> } } }",
        "SOLID { TERRAIN { VERTICES { 2 2 <0,0,0> <0,1,0> <1,0,0> <1,1,0> } } }",
    ),
    "M3D0410": _error(
        "Need at least 3 PROFILE points",
        "A temperature profile has 3 to 200 points.",
        "SCENE { MIRAGE { PROFILE { 0 10 20 12 } } }",
        "SCENE { MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0411": _error(
        "PROFILE elevations must be increasing",
        "The points of a temperature profile are listed from low to high. There is no restriction on temperatures.",
        "SCENE { MIRAGE { PROFILE { 0 10 20 12 5 11 } } }",
        "SCENE { MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0412": _error(
        "Too many {}",
        "A temperature profile has at most 200 points, a texture at most 20 colour ranges. A scene has at most 2 million "
        "solids, primitives and textures, and 20 million vertices and facets, each copy counted.",
        "SCENE { MIRAGE { PROFILE { " + " ".join(f"{i / 10:.1f} 10" for i in range(201)) + " } } }",
        "SCENE { MIRAGE { PROFILE { " + " ".join(f"{i / 10:.1f} 10" for i in range(200)) + " } } }",
    ),
    "M3D0413": _error(
        "Second index must be greater than first",
        "Colour ranges run upwards between 0 and 1 and do not overlap: u < v, and u is not below the v before.",
        "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { 0.5 0.2 <1,0,0> <0,1,0> } } } } }",
        "SOLID { SPHERE { } SURFACE { TEXTURE { WOOD { COLORS { 0.2 0.5 <1,0,0> <0,1,0> } } } } }",
    ),
    "M3D0414": _error(
        "Sun must be above the horizon",
        "Sunlight travels downwards: the z component of its direction is negative.",
        "SCENE { SKY { SUN { DIRECTION < 1, 0, 0.5 > } } }",
        "SCENE { SKY { SUN { DIRECTION < 1, 0, -0.5 > } } }",
    ),
    "M3D0415": _error(
        "Distance between FROM and TO is too small",
        "Two points give a direction only if they differ.",
        "SCENE { VIEW { FROM < 1, 2, 3 > TO < 1, 2, 3 > } }",
        "SCENE { VIEW { FROM < 1, 2, 3 > TO < 0, 2, 3 > } }",
    ),
    "M3D0416": _warning(
        "REGION bottom must be >= top",
        "The bottom of the region is set to its top: one row of pixels is left.",
        "SCENE { SKY { } VIEW { REGION 20, 0, 10, 99 } }",
        "SCENE { SKY { } VIEW { REGION 10, 0, 20, 99 } }",
    ),
    "M3D0417": _warning(
        "REGION right must be >= left",
        "The right of the region is set to its left: one column of pixels is left. The order is top, left, bottom, right.",
        "SCENE { SKY { } VIEW { REGION 0, 99, 20, 10 } }",
        "SCENE { SKY { } VIEW { REGION 0, 10, 20, 99 } }",
    ),
    "M3D0418": _error(
        "Observer position below all temperature layers",
        "With a mirage the eye, VIEW's FROM, must stand between the lowest and the highest elevation of the PROFILE.",
        "SCENE { VIEW { FROM < 20, 0, -1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
        "SCENE { VIEW { FROM < 20, 0, 1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0419": _error(
        "Observer position above all temperature layers",
        "With a mirage the eye, VIEW's FROM, must stand between the lowest and the highest elevation of the PROFILE.",
        "SCENE { VIEW { FROM < 20, 0, 30 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
        "SCENE { VIEW { FROM < 20, 0, 19 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0420": _error(
        "Direction must not be zero",
        "A direction is a vector of any length but zero.",
        "LIGHT { SOURCE { DIRECTION < 0, 0, 0 > } }",
        "LIGHT { SOURCE { DIRECTION < 0, 0, -1 > } }",
    ),
    "M3D0421": _error(
        "Transform can not be inverted",
        "A transformation's numbers are so large or small that it can not be undone, which texturing needs.",
        "SOLID { SPHERE { TRANSFORM { SCALEX 1e-320 } } }",
        "SOLID { SPHERE { TRANSFORM { SCALEX 1e-3 } } }",
    ),
    "M3D0422": _warning(
        "{}",
        "The number is out of range, and the nearest limit takes its place.",
        "SCENE { SKY { OVERCAST 1.5 } }",
        "SCENE { SKY { OVERCAST 1 } }",
    ),
    "M3D0423": _warning(
        "{}",
        "The number is out of the range it should be in, and is used all the same.",
        "SCENE { SKY { INTENSITY 1.5 } }",
        "SCENE { SKY { INTENSITY 1 } }",
    ),
    "M3D0424": _error(
        "Nothing may reach farther than 1e30",
        "Once everything is transformed, no coordinate in the world is beyond 1e30, up to which pictures are exact. What "
        "a scene writes down is within 1e20 in itself; a scale factor that is meant to be much smaller carries it farther.",
        "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e140 } } }",
        "SOLID { SPHERE { RADIUS 1e20 TRANSFORM { SCALEX 1e4 } } }",
    ),
    # --- probably not what was meant ------------------------------------------------------------------------------------
    "M3D0501": _warning(
        "TRANSFORM discards the transformations before it",
        "`TRANSFORM name` replaces the matrix. To build on it, put the name first and the blocks after it.",
        "VARIABLES { TRANSFORM turn; } turn = { ROTZ 30 } "
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ TRANSX 5 }} TRANSFORM turn }} }}",
        "VARIABLES { TRANSFORM turn; } turn = { ROTZ 30 } "
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM turn TRANSFORM {{ TRANSX 5 }} }} }}",
    ),
    "M3D0502": _warning(
        "IDENTITY discards the transformations before it",
        "IDENTITY clears the matrix; what stands before it in the block has no effect.",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ TRANSX 5 IDENTITY ROTZ 30 }} }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ IDENTITY ROTZ 30 }} }} }}",
    ),
    "M3D0503": _warning(
        "Unused variable",
        "The variable is never used. Variables do not become part of a scene by themselves.",
        f"VARIABLES {{ NUMBER size; }} size = 2 {_LIT} SOLID {{ SPHERE {{ }} }}",
        f"VARIABLES {{ NUMBER size; }} size = 2 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
    ),
    "M3D0504": _warning(
        "Variable used before it is assigned",
        "At its use the variable still has its default value: 0 for a number, the statements' defaults for a structure.",
        f"VARIABLES {{ SPHERE ball; }} {_LIT} SOLID {{ SPHERE ball }} ball = {{ RADIUS 2 }}",
        f"VARIABLES {{ SPHERE ball; }} {_LIT} ball = {{ RADIUS 2 }} SOLID {{ SPHERE ball }}",
    ),
    "M3D0505": _warning(
        "Light reaches nothing",
        "The light is black, has no intensity, or shines past everything in the scene.",
        "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 9, 0, 0 > TO < 20, 0, 0 > ANGLE 30 } }",
        "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 9, 0, 0 > TO < 0, 0, 0 > ANGLE 30 } }",
    ),
    "M3D0506": _warning(
        "Observer stands on a layer boundary",
        "The eye is within a tenth of a millimetre of a point of the PROFILE, where the curvature of rays changes at once. "
        "If the layer below bends rays down and the layer above bends them up, rays just below and just above the "
        "horizontal go different ways, and the picture has a gap at the height of the eye.",
        "SCENE { SKY { } VIEW { FROM < 20, 0, 5 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
        "SCENE { SKY { } VIEW { FROM < 20, 0, 5.1 > } MIRAGE { PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0507": _hint(
        "Texture stays in place when its object moves",
        "The object is transformed and its texture is not LOCAL, so the pattern is that of the scene at the object's new "
        "place. That may be what is wanted.",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ WOOD {{ }} }} }} TRANSFORM {{ TRANSX 5 }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ WOOD {{ LOCAL }} }} }} TRANSFORM {{ TRANSX 5 }} }}",
    ),
    "M3D0508": _warning(
        "A curved ray has 1000000 arcs at most",
        "SEGMENTS beyond that has no effect: memory and time for a ray are bounded. A ray through the air of a whole day's "
        "sight has a few thousand.",
        "SCENE { SKY { } MIRAGE { SEGMENTS 2000000 PROFILE { 0 10 5 11 20 12 } } }",
        "SCENE { SKY { } MIRAGE { SEGMENTS 1000000 PROFILE { 0 10 5 11 20 12 } } }",
    ),
    "M3D0509": _warning(
        "A scaled sphere stays a sphere",
        "The transformation scales differently in different directions, but a sphere only grows, by the largest factor.",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ SCALE < 1, 1, 3 > }} }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ SCALE < 3, 3, 3 > }} }} }}",
    ),
    "M3D0510": _warning(
        "Vertices that no facet uses",
        "They have no effect but on the scene's extents.",
        f"{_LIT} SOLID {{ POLYGONS {{ VERTICES {{ 4 <0,0,0> <1,0,0> <0,1,0> <5,5,5> }} FACETS {{ 1 0 1 2 }} }} }}",
        f"{_LIT} SOLID {{ POLYGONS {{ {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
    ),
    "M3D0511": _warning(
        "Normal on wrong side of facet",
        "With PHONG a corner's normal must point to the side from which the facet's corners run counter-clockwise; "
        "otherwise there is a black hole.",
        f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,-1> }} }} }}",
        f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
    ),
    "M3D0512": _warning(
        "Only the last {} counts",
        "The same statement stands twice in one block; each overwrites the one before it. So does a SURFACE or SOURCE that "
        "is a copy of a variable.",
        f"{_LIT} SOLID {{ SPHERE {{ RADIUS 2 RADIUS 3 }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ RADIUS 3 }} }}",
    ),
    "M3D0513": _warning(
        "Scene without light",
        "There is neither a LIGHT nor a SKY: solids show by ambient light alone, nearly black.",
        "SOLID { SPHERE { } }",
        "SOLID { SPHERE { } } SCENE { SKY { } }",
    ),
    # --- without effect, or in another unit ---------------------------------------------------------------------------
    "M3D0514": _warning(
        "PHONG has no effect without SFACETS",
        "PHONG interpolates the normals at the corners of facets. FACETS gives none; SFACETS does.",
        f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} FACETS {{ 1 0 1 2 }} }} }}",
        f"{_LIT} SOLID {{ POLYGONS {{ PHONG {_TRIANGLE} SFACETS {{ 1 0 1 2 <0,0,1> <0,0,1> <0,0,1> }} }} }}",
    ),
    "M3D0515": _warning(
        "{} has no effect on this light",
        "ANGLE, EXPONENT and ATTENUATION are about a POINT light. Its DIRECTION, ZENITH and AZIMUTH count only where ANGLE "
        "or EXPONENT narrow it: where it stands is its FROM.",
        "SOLID { SPHERE { } } LIGHT { SOURCE { FROM < 0, 0, 9 > TO < 0, 0, 0 > ANGLE 20 } }",
        "SOLID { SPHERE { } } LIGHT { SOURCE { POINT FROM < 0, 0, 9 > TO < 0, 0, 0 > ANGLE 20 } }",
    ),
    "M3D0516": _warning(
        "{} has no effect without a WAVE",
        "WAVES and RIPPLES are the sum of the sources of waves that stand in them; there is none by itself.",
        f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ WAVES {{ }} }} }} }}",
        f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ WAVES {{ WAVE {{ FREQ 2 }} }} }} }} }}",
    ),
    "M3D0517": _warning(
        "{} has no effect in this texture",
        "Every texture can be given every statement, but each kind uses only some of them. With COLORS, COLOR is not used.",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ CHECKER {{ TURBULENCE 2 }} }} }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ TEXTURE {{ MARBLE {{ TURBULENCE 2 }} }} }} }}",
    ),
    "M3D0518": _warning(
        "{} has no effect on a PLANE",
        "UBLEND and VBLEND change a colour from one side of a primitive to the other. A PLANE has no sides.",
        f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ UBLEND {{ COLOR < 0, 0, 1 > }} }} }} }}",
        f"{_LIT} SOLID {{ RECTANGLE {{ }} SURFACE {{ TEXTURE {{ UBLEND {{ COLOR < 0, 0, 1 > }} }} }} }}",
    ),
    "M3D0519": _warning(
        "BACKGROUND is never seen",
        "Where a ray meets nothing the SKY is seen; without one, the HAZE; without either, the BACKGROUND.",
        "SCENE { BACKGROUND < 0, 0, 0.5 > SKY { } }",
        "SCENE { SKY { ZENITHCOLOR < 0, 0, 0.5 > } }",
    ),
    "M3D0520": _warning(
        "Ambient light is not sampled",
        "Light from around is sampled with both: NSAMPLES, the number of rays from each surface, and a DEPTH of 2 or more. "
        "Otherwise it is constant.",
        "SOLID { SPHERE { } } SCENE { SKY { } AMBIENT { NSAMPLES 8 } }",
        "SOLID { SPHERE { } } SCENE { SKY { } AMBIENT { NSAMPLES 8 DEPTH 2 } }",
    ),
    "M3D0521": _hint(
        "NOSHADOWS has no effect without SHADOWS",
        "Lights cast shadows only if the SCENE says SHADOWS, or a renderer is asked for them.",
        "SOLID { SPHERE { } } SCENE { SKY { SUN { NOSHADOWS } } }",
        "SOLID { SPHERE { } } SCENE { SHADOWS SKY { SUN { NOSHADOWS } } }",
    ),
    "M3D0522": _warning(
        "{} has no effect on this surface",
        "HARD and METALLIC are about light that is reflected specularly, and need a SPECULAR above 0.",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ SPECULAR 0 HARD 0.9 }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ SPECULAR 0.5 HARD 0.9 }} }}",
    ),
    "M3D0523": _hint(
        "This {} changes the one before it",
        "A second SURFACE or SOURCE in braces does not take the place of the first: it changes what it names and keeps the "
        "rest.",
        f"VARIABLES {{ SURFACE matt; }} matt = {{ ROUGH 1 }} {_LIT} SOLID {{ SPHERE {{ }} SURFACE matt SURFACE {{ SPECULAR 0 }} }}",
        f"VARIABLES {{ SURFACE matt; }} matt = {{ ROUGH 1 }} {_LIT} SOLID {{ SPHERE {{ }} SURFACE matt {{ SPECULAR 0 }} }}",
    ),
    "M3D0524": _warning(
        "Value is never used",
        "A variable is given another value before anything uses this one, or is not used any more. An assignment counts "
        "from its place in the file on.",
        f"VARIABLES {{ NUMBER size; }} size = 2 size = 3 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
        f"VARIABLES {{ NUMBER size; }} size = 3 {_LIT} SOLID {{ SPHERE {{ RADIUS size }} }}",
    ),
    "M3D0525": _warning(
        "Temperatures look like kelvin",
        "The temperatures of a PROFILE are in degrees Celsius. No air is as hot as these.",
        "SCENE { SKY { } MIRAGE { PROFILE { 0 283 5 284 20 285 } } }",
        "SCENE { SKY { } MIRAGE { PROFILE { 0 9.85 5 10.85 20 11.85 } } }",
    ),
    "M3D0526": _warning(
        "Nothing stands before the camera",
        "Every solid and every visible light is behind the eye, or beside what it sees. VIEW's FROM is where the eye is, TO "
        "what it looks at, FOV how wide.",
        "SOLID { SPHERE { CENTER < 90, 0, 6 > } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
        "SOLID { SPHERE { CENTER < 90, 0, 6 > } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 90, 0, 6 > } }",
    ),
    "M3D0527": _warning(
        "Camera inside a SPHERE",
        "The eye is in a sphere that nothing else reaches into and no light stands in: only its inside is seen.",
        "SOLID { SPHERE { CENTER < 20, 0, 6 > RADIUS 2 } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
        "SOLID { SPHERE { CENTER < 0, 0, 6 > RADIUS 2 } } SCENE { SKY { } VIEW { FROM < 20, 0, 6 > TO < 0, 0, 6 > } }",
    ),
    "M3D0528": _hint(
        "Angle looks like radians",
        "Angles are in degrees. These are: a common part of a turn as it is in radians, such as 1.57; or rotations of a "
        "scene that has none of more than 6.28 degrees.",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ ROTZ 1.57 }} }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ TRANSFORM {{ ROTZ 90 }} }} }}",
    ),
    "M3D0529": _warning(
        "{} has no effect in a scene of planes",
        "SNOW and GRADIENT go by the heights of the scene, from its lowest to its highest point, in which planes do not "
        "count: they have no end.",
        f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ SNOW {{ ELEVATION 0.5 }} }} }} }}",
        f"{_LIT} SOLID {{ PLANE {{ }} SURFACE {{ TEXTURE {{ SNOW {{ ELEVATION 0 }} }} }} }} SOLID {{ SPHERE {{ }} }}",
    ),
    "M3D0530": _warning(
        "{}",
        "The components of a colour go from 0 to 1, and these seem to go from 0 to 255: divide them by 255. What is above 1 "
        "counts as 1.",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ COLOR < 255, 128, 0 > }} }}",
        f"{_LIT} SOLID {{ SPHERE {{ }} SURFACE {{ COLOR < 1, 0.502, 0 > }} }}",
    ),
}
