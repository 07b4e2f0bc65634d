autocmd BufRead,BufNewFile *.m3d setfiletype m3d
