/** What the item in the status bar shows of the language server, in words. */

import type { ServerState } from "./server";

export interface Look {
  text: string;
  tooltip: string;
  label: string;
  color?: string;
}

export const HOW_TO_INSTALL = "Bring it with `make tools` in the project's clone, then name it in m3d.server.path.";

/** What the item shows. */
export function look(state: ServerState, trusted: boolean): Look {
  switch (state.kind) {
    case "starting":
      return {
        text: "$(sync~spin) Mirage3D",
        tooltip: "The language server is starting.",
        label: "Mirage3D: the language server is starting",
      };
    case "running": {
      const restricted = trusted ? "" : " Restricted Mode: nothing is rendered.";
      return {
        text: trusted ? "$(check) Mirage3D" : "$(shield) Mirage3D",
        tooltip: `${state.program} ${state.version}`.trim() + restricted,
        label: `Mirage3D: the language server runs.${restricted}`,
      };
    }
    case "missing":
      return {
        text: "$(warning) Mirage3D",
        tooltip: `The language server m3d-lsp was not found. Looked at:\n${state.looked.join("\n")}\n${HOW_TO_INSTALL}`,
        label: "Mirage3D: the language server was not found",
        color: "statusBarItem.warningBackground",
      };
    case "failed":
      return {
        text: "$(error) Mirage3D",
        tooltip: state.reason,
        label: `Mirage3D: ${state.reason}`,
        color: "statusBarItem.errorBackground",
      };
  }
}
