-- What a person does with a scene in Neovim, and what comes of it, as JSON in the file that $RESULT names.
-- Run by test_neovim.py.

local result = {}

local function wait(what)
  return vim.wait(20000, what, 20)
end

local function diagnostics()
  return vim.tbl_map(function(each)
    return { line = each.lnum, column = each.col, code = each.code, message = each.message }
  end, vim.diagnostic.get(0))
end

local function text()
  return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
end

local function cursor(line, column)
  vim.api.nvim_win_set_cursor(0, { line, column })
end

local function replace(line, old, new)
  local now = vim.api.nvim_buf_get_lines(0, line - 1, line, false)[1]
  local from, to = now:find(old, 1, true)
  vim.api.nvim_buf_set_text(0, line - 1, from - 1, line - 1, to, { new })
end

-- Mistakes are shown, and go when they are mended.
assert(wait(function()
  return #vim.diagnostic.get(0) > 0
end), "no diagnostics")
result.diagnostics = diagnostics()
replace(3, "-5", "5")
assert(wait(function()
  return #vim.diagnostic.get(0) == 0
end), "the diagnostics stay")

-- K
cursor(3, 10)
vim.lsp.buf.hover()
assert(wait(function()
  return #vim.api.nvim_list_wins() > 1
end), "no hover")
for _, window in ipairs(vim.api.nvim_list_wins()) do
  if window ~= vim.api.nvim_get_current_win() then
    local shown = vim.api.nvim_win_get_buf(window)
    result.hover = table.concat(vim.api.nvim_buf_get_lines(shown, 0, -1, false), "\n")
    vim.api.nvim_win_close(window, true)
  end
end

-- CTRL-X CTRL-O
replace(3, "RADIUS 5", "RAD RADIUS 5")
cursor(3, 20)
local answers = vim.lsp.buf_request_sync(0, "textDocument/completion", vim.lsp.util.make_position_params(), 20000)
result.completion = {}
for _, answer in pairs(answers or {}) do
  local given = answer.result or {}
  for _, item in ipairs(given.items or given) do
    table.insert(result.completion, item.label)
  end
end
replace(3, "RAD RADIUS", "RADIUS")

-- gd, on the use of `red`: of several places the cursor goes to the first, and a window lists all
local window = vim.api.nvim_get_current_win()
cursor(4, 9)
vim.lsp.buf.definition()
assert(wait(function()
  return vim.api.nvim_win_get_cursor(window)[1] ~= 4
end), "the cursor has not moved")
result.definition = vim.api.nvim_win_get_cursor(window)
vim.cmd("cclose")
vim.api.nvim_set_current_win(window)

-- rename
vim.lsp.buf.rename("crimson")
assert(wait(function()
  return text():find("crimson", 1, true)
end), "nothing was renamed")
result.renamed = text()

-- format
require("mirage3d").format()
result.formatted = text()

-- :MirageDump, which follows the text
vim.cmd("MirageDump")
local function dump()
  for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
    if vim.bo[buffer].buftype == "nofile" and vim.api.nvim_buf_line_count(buffer) > 1 then
      return table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n")
    end
  end
  return ""
end
assert(wait(function()
  return dump():find(": 5.000000", 1, true)
end), "no dump")
for line = 1, vim.api.nvim_buf_line_count(0) do
  if vim.fn.getline(line):find("RADIUS 5", 1, true) then
    replace(line, "RADIUS 5", "RADIUS 7")
  end
end
result.dump_follows = wait(function()
  return dump():find(": 7.000000", 1, true)
end)

-- :MirageRender
local picture = vim.env.RESULT .. ".png"
vim.cmd("MirageRender " .. picture)
result.rendered = wait(function()
  return vim.fn.filereadable(picture) == 1
end)

local file = assert(io.open(vim.env.RESULT, "w"))
file:write(vim.fn.json_encode(result))
file:close()
