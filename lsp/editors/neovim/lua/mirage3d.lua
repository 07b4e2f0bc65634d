-- Mirage3D scenes in Neovim (0.7 or newer), with its own language client: nothing else needs to be installed.
--
-- vim.g.mirage3d = {
--   command = { "m3d-lsp" },                 -- how the server is started
--   settings = { diagnostics = { deny = { "all" } } },
--   keymaps = false,                          -- none of the keys below
-- }

local M = {}

local options = vim.tbl_extend("force", { command = { "m3d-lsp" }, settings = {}, keymaps = true }, vim.g.mirage3d or {})

-- The client, and the dumps that are shown: the buffer of each, by the buffer of its scene.
local client_id
local dumps = {}

local KEYS = {
  K = { vim.lsp.buf.hover, "what is this?" },
  gd = { vim.lsp.buf.definition, "where a variable gets its value" },
  gD = { vim.lsp.buf.declaration, "where it is declared" },
  gr = { vim.lsp.buf.references, "where it is used" },
  ["<leader>rn"] = { vim.lsp.buf.rename, "rename" },
  ["<leader>ca"] = { vim.lsp.buf.code_action, "mend" },
  ["<leader>f"] = {
    function()
      M.format()
    end,
    "format",
  },
  ["<leader>e"] = { vim.diagnostic.open_float, "what is wrong here?" },
  ["[d"] = { vim.diagnostic.goto_prev, "the mistake before" },
  ["]d"] = { vim.diagnostic.goto_next, "the next mistake" },
}

local function uri(buffer)
  return { uri = vim.uri_from_bufnr(buffer) }
end

local function request(buffer, method, params, handler)
  local client = client_id and vim.lsp.get_client_by_id(client_id)
  if client then
    client.request(method, params, function(problem, answer)
      if problem then
        vim.notify(problem.message, vim.log.levels.ERROR)
      else
        handler(answer)
      end
    end, buffer)
  end
end

-- Fill the buffer of a dump, if there is one for the scene.
local function refresh(scene)
  local shown = dumps[scene]
  if not shown then
    return
  end
  if not vim.api.nvim_buf_is_valid(shown) or not vim.api.nvim_buf_is_valid(scene) then
    dumps[scene] = nil
    return
  end
  request(scene, "m3d/dump", { textDocument = uri(scene) }, function(answer)
    if not vim.api.nvim_buf_is_valid(shown) then
      return
    end
    vim.bo[shown].modifiable = true
    vim.api.nvim_buf_set_lines(shown, 0, -1, false, vim.split(answer.text, "\n"))
    vim.bo[shown].modifiable = false
    vim.b[shown].stale = answer.stale
  end)
end

-- Lay a scene out; Neovim 0.8 has another name for it.
function M.format()
  if vim.lsp.buf.format then
    vim.lsp.buf.format({ async = false })
  else
    vim.lsp.buf.formatting_sync(nil, 5000)
  end
end

-- Show what a scene resolves to beside it, and keep that up to date.
function M.dump()
  local scene = vim.api.nvim_get_current_buf()
  vim.cmd("rightbelow vnew")
  local shown = vim.api.nvim_get_current_buf()
  vim.bo[shown].buftype = "nofile"
  vim.bo[shown].bufhidden = "wipe"
  vim.bo[shown].swapfile = false
  vim.cmd("wincmd p")
  dumps[scene] = shown
  refresh(scene)
end

-- Render a scene as it stands in the buffer into a picture file.
function M.render(path, straight)
  local scene = vim.api.nvim_get_current_buf()
  local params = {
    textDocument = uri(scene),
    optics = straight and "straight" or "mirage",
    path = vim.fn.fnamemodify(path, ":p"),
  }
  request(scene, "m3d/preview/save", params, function(answer)
    local level = answer.status == "error" and vim.log.levels.ERROR or vim.log.levels.INFO
    vim.notify(answer.message or (answer.path .. ": " .. answer.status), level)
  end)
end

local function on_attach(_, buffer)
  vim.bo[buffer].omnifunc = "v:lua.vim.lsp.omnifunc"
  vim.bo[buffer].tagfunc = "v:lua.vim.lsp.tagfunc"
  for key, map in pairs(options.keymaps and KEYS or {}) do
    vim.keymap.set("n", key, map[1], { buffer = buffer, desc = map[2] })
  end
  vim.api.nvim_buf_create_user_command(buffer, "MirageDump", M.dump, {})
  vim.api.nvim_buf_create_user_command(buffer, "MirageRender", function(given)
    M.render(given.args, given.bang)
  end, { nargs = 1, bang = true, complete = "file" })
end

-- Serve a buffer; all buffers share a server.
function M.attach(buffer)
  buffer = buffer == 0 and vim.api.nvim_get_current_buf() or buffer
  local running = client_id and vim.lsp.get_client_by_id(client_id)
  if not running or running.is_stopped() then
    local capabilities = vim.lsp.protocol.make_client_capabilities()
    capabilities.experimental = { m3d = { analysed = true } } -- for dumps that follow their scene
    client_id = vim.lsp.start_client({
      name = "m3d-lsp",
      cmd = options.command,
      root_dir = vim.fn.getcwd(),
      settings = { m3d = options.settings },
      capabilities = capabilities,
      on_attach = on_attach,
      handlers = {
        ["m3d/analysed"] = function(_, params)
          refresh(vim.uri_to_bufnr(params.uri))
        end,
      },
    })
  end
  if client_id then
    vim.lsp.buf_attach_client(buffer, client_id)
  end
end

return M
