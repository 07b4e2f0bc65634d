" Generated from grammar/language.toml by `make generate`.

if exists('b:current_syntax')
  finish
endif

syntax case match
syntax iskeyword @,48-57,_

syntax keyword m3dBlock BUMPS CHECKER CLOUDS GRADIENT GRANITE HAZE LIGHT MARBLE MIRAGE NUMBER PLANE POLYGONS RECTANGLE RIPPLES SCENE SKY SNOW SOLID SOURCE SPHERE SPOTTED SUN SURFACE TERRAIN TEXTURE TRANSFORM TRIANGLE UBLEND VBLEND VECTOR VIEW WAVE WAVES WOOD
syntax keyword m3dProperty AMPLITUDE ANGLE ASPECT ATTENUATION AZIMUTH BACKGROUND CENTER COLOR COLORS DAMP DENSITY DEPTH DIRECTION DISTANCE ELEVATION EXPONENT FACETS FOV FREQ FROM FUZZ HARD HEIGHT HORIZONCOLOR INTENSITY LOGSCALE METALLIC NSAMPLES OVERCAST PHASE PROFILE RADIUS REFINDEX REGION ROTATE ROTX ROTY ROTZ ROUGH SCALE SCALEX SCALEY SCALEZ SEGMENTS SFACETS SLOPE SPECULAR SQUEEZE TILT TO TRANSLATE TRANSX TRANSY TRANSZ TURBULENCE VERTEX1 VERTEX2 VERTEX3 VERTICES WIDTH ZENITH ZENITHCOLOR
syntax keyword m3dFlag IDENTITY INFINITE LOCAL NOPHONG NOSHADOWS NOSPECULAR PHONG POINT SHADOWS
syntax keyword m3dKeyword ID LUMINANCE PRIMITIVES VARIABLES WIREFRAME

syntax match m3dVariable /\<[A-Za-z][A-Za-z0-9_]*\>/
syntax match m3dProperty /\<\%(AMBIENT\)\>/
syntax match m3dBlock /\<\%(AMBIENT\)\>\ze\s*\%({\|\/\*\|$\)/
" A malformed numeral is one token too.
syntax match m3dNumber /[+-]\?\.\?[0-9]\%([eE][+-]\|[A-Za-z0-9_.]\)*/
syntax match m3dOperator /=/
syntax match m3dDelimiter /[{}<>,;]/
" Comments nest.
syntax region m3dComment start=+/\*+ end=+\*/+ contains=m3dComment,@Spell
syntax sync minlines=300

highlight default link m3dBlock Type
highlight default link m3dProperty Statement
highlight default link m3dFlag Constant
highlight default link m3dKeyword Keyword
highlight default link m3dVariable Identifier
highlight default link m3dNumber Number
highlight default link m3dOperator Operator
highlight default link m3dDelimiter Delimiter
highlight default link m3dComment Comment

let b:current_syntax = 'm3d'
