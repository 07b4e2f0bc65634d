" Mirage3D scenes are indented as m3dfmt does it: a level for each open brace, and the names of a declaration that goes
" on to another line below its first one.
if exists('b:did_indent')
  finish
endif
let b:did_indent = 1

setlocal indentexpr=M3dIndent(v:lnum)
setlocal indentkeys=0{,0},!^F,o,O

let b:undo_indent = 'setlocal indentexpr< indentkeys<'

if exists('*M3dIndent')
  finish
endif

" Whether a comment that begins further up is still open where a line begins.
function! s:InComment(line) abort
  let l:depth = 0
  for l:text in getline(max([1, a:line - 300]), a:line - 1)
    let l:depth += count(l:text, '/*') - count(l:text, '*/')
    let l:depth = max([l:depth, 0])
  endfor
  return l:depth > 0
endfunction

" The line before that holds more than comments, or 0.
function! s:Before(line) abort
  let l:line = prevnonblank(a:line - 1)
  while l:line > 0 && (s:Text(l:line) =~# '^\s*$' || s:InComment(l:line))
    let l:line = prevnonblank(l:line - 1)
  endwhile
  return l:line
endfunction

" A line without its comments.
function! s:Text(line) abort
  return substitute(getline(a:line), '/\*.\{-}\%(\*/\|$\)', '', 'g')
endfunction

" The columns that a line is to be indented by; -1 inside a comment, whose lines stay.
function! M3dIndent(line) abort
  if s:InComment(a:line)
    return -1
  endif
  let l:before = s:Before(a:line)
  if l:before == 0
    return 0
  endif
  let l:goes_on = s:Text(l:before) =~# ',\s*$'
  " From the first line of what goes on over several.
  let l:above = s:Before(l:before)
  while l:above > 0 && s:Text(l:above) =~# ',\s*$'
    let l:before = l:above
    let l:above = s:Before(l:before)
  endwhile
  let l:text = s:Text(l:before)
  if l:goes_on
    return max([strdisplaywidth(matchstr(l:text, '^\s*\S\+\s\+')), indent(l:before)])
  endif
  " The brace that begins a line was counted where the line was indented.
  let l:rest = substitute(l:text, '^\s*}', '', '')
  let l:depth = count(l:rest, '{') - count(l:rest, '}') - (getline(a:line) =~# '^\s*}')
  return max([indent(l:before) + l:depth * shiftwidth(), 0])
endfunction
