//! Tells Zed how `m3d-lsp` is started: as it is found on the path.

use zed_extension_api::{self as zed, LanguageServerId, Worktree};

struct Mirage3d;

impl zed::Extension for Mirage3d {
    fn new() -> Self {
        Self
    }

    fn language_server_command(&mut self, _: &LanguageServerId, worktree: &Worktree) -> zed::Result<zed::Command> {
        let command = worktree.which("m3d-lsp").ok_or("m3d-lsp is not on the path; docs/editors.md says how to get it")?;
        Ok(zed::Command { command, args: Vec::new(), env: worktree.shell_env() })
    }
}

zed::register_extension!(Mirage3d);
