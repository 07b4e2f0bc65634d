/** What a person can do when there is no server or no picture: the words for it, and the commands behind them. */

import type { Obstacle } from "mirage3d-picture/host";
import { HOW_TO_INSTALL } from "./look";
import type { ServerState } from "./server";

export const COMMANDS = {
  "Open Preview": "m3d.preview",
  "Show Output": "m3d.showOutput",
  "Restart Language Server": "m3d.restartServer",
  "Try Again": "m3d.restartServer",
  "Choose Program...": "m3d.chooseServer",
  "Manage Workspace Trust": "workbench.trust.manage",
} as const;

export type Action = keyof typeof COMMANDS;

/** The command of an action; undefined for what is none. */
export function commandOf(action: string | undefined): string | undefined {
  return action !== undefined && Object.hasOwn(COMMANDS, action) ? COMMANDS[action as Action] : undefined;
}

/** Why there can be no picture, and what to do about it; null: there can. */
export function obstacle(state: ServerState, trusted: boolean): Obstacle | null {
  const because = (reason: string, ...actions: Action[]): Obstacle => ({ reason, actions });
  if (!trusted) {
    const reason = "Nothing is rendered in Restricted Mode. Trust the workspace to see the picture.";
    return because(reason, "Manage Workspace Trust");
  }
  switch (state.kind) {
    case "running":
      return null;
    case "starting":
      return because("The language server is starting...", "Show Output");
    case "missing": {
      const reason = `The language server, m3d-lsp, was not found. ${HOW_TO_INSTALL}`;
      return because(reason, "Choose Program...", "Try Again", "Show Output");
    }
    case "failed":
      return because(state.reason, "Try Again", "Choose Program...", "Show Output");
  }
}
