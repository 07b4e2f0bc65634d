"""A scene in its canonical layout, which editors keep when they indent it."""

LAID_OUT = """\
/* A comment
     whose lines stay. */
VARIABLES
{
    VECTOR  tan_stone, grey_stone, /* { */
            grass,
            sand;
    SURFACE matt;
}

tan_stone = < 0.86, 0.58, 0.44 >
SCENE { SHADOWS }
SOLID /* { */
{
    POLYGONS
    {
        VERTICES
        {
            3
            < 0, 0, 0 >
            < 1, 0, 0 >
            < 0, 1, 0 >
        }
        FACETS { 1 0 1 2 }
        TRANSFORM
        {
            ROTZ 45
        } /* } */
    }
    SURFACE { COLOR tan_stone }
}
LIGHT { }
"""
