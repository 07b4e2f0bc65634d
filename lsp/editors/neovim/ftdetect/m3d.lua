vim.api.nvim_create_autocmd({ "BufRead", "BufNewFile" }, {
  pattern = "*.m3d",
  callback = function()
    vim.bo.filetype = "m3d"
  end,
})
