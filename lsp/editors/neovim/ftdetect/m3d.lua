-- Colours and indentation are those of Vim, from the folder beside this one.
local here = vim.fn.fnamemodify(debug.getinfo(1, "S").source:sub(2), ":p:h:h:h")
vim.opt.runtimepath:append(here .. "/vim")

vim.api.nvim_create_autocmd({ "BufRead", "BufNewFile" }, {
  pattern = "*.m3d",
  callback = function()
    vim.bo.filetype = "m3d"
  end,
})
