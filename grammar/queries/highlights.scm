; Generated from language.toml by `make generate`.

; Blocks and types, members, flags, and what is none of these.

[
  "BUMPS"
  "CHECKER"
  "CLOUDS"
  "GRADIENT"
  "GRANITE"
  "HAZE"
  "LIGHT"
  "MARBLE"
  "MIRAGE"
  "NUMBER"
  "PLANE"
  "POLYGONS"
  "RECTANGLE"
  "RIPPLES"
  "SCENE"
  "SKY"
  "SNOW"
  "SOLID"
  "SOURCE"
  "SPHERE"
  "SPOTTED"
  "SUN"
  "SURFACE"
  "TERRAIN"
  "TEXTURE"
  "TRANSFORM"
  "TRIANGLE"
  "UBLEND"
  "VBLEND"
  "VECTOR"
  "VIEW"
  "WAVE"
  "WAVES"
  "WOOD"
] @type

[
  "AMPLITUDE"
  "ANGLE"
  "ASPECT"
  "ATTENUATION"
  "AZIMUTH"
  "BACKGROUND"
  "CENTER"
  "COLOR"
  "COLORS"
  "DAMP"
  "DENSITY"
  "DEPTH"
  "DIRECTION"
  "DISTANCE"
  "ELEVATION"
  "EXPONENT"
  "FACETS"
  "FOV"
  "FREQ"
  "FROM"
  "FUZZ"
  "HARD"
  "HEIGHT"
  "HORIZONCOLOR"
  "INTENSITY"
  "LOGSCALE"
  "METALLIC"
  "NSAMPLES"
  "OVERCAST"
  "PHASE"
  "PROFILE"
  "RADIUS"
  "REFINDEX"
  "REGION"
  "ROTATE"
  "ROTX"
  "ROTY"
  "ROTZ"
  "ROUGH"
  "SCALE"
  "SCALEX"
  "SCALEY"
  "SCALEZ"
  "SEGMENTS"
  "SFACETS"
  "SLOPE"
  "SPECULAR"
  "SQUEEZE"
  "TILT"
  "TO"
  "TRANSLATE"
  "TRANSX"
  "TRANSY"
  "TRANSZ"
  "TURBULENCE"
  "VERTEX1"
  "VERTEX2"
  "VERTEX3"
  "VERTICES"
  "WIDTH"
  "ZENITH"
  "ZENITHCOLOR"
] @property

[
  "IDENTITY"
  "INFINITE"
  "LOCAL"
  "NOPHONG"
  "NOSHADOWS"
  "NOSPECULAR"
  "PHONG"
  "POINT"
  "SHADOWS"
] @attribute

[
  "ID"
  "LUMINANCE"
  "PRIMITIVES"
  "VARIABLES"
  "WIREFRAME"
] @keyword

(block keyword: "AMBIENT" @type)

(statement keyword: "AMBIENT" @property)

(comment) @comment

[(number) (numeric_table)] @number

(identifier) @variable

["{" "}" "<" ">"] @punctuation.bracket

["," ";"] @punctuation.delimiter

"=" @operator
