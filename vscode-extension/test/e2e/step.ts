import { test } from "node:test";

import type { Workbench } from "./workbench";

/** Makes tests of what a person does; if a step fails there is a screenshot of how it was. */
export function stepper(workbench: () => Workbench): (name: string, act: () => Promise<void>) => void {
  return (name, act) => {
    void test(name, async () => {
      try {
        await act();
      } catch (fault) {
        await workbench().screenshot(`failed-${name.replace(/\W+/g, "-")}`);
        throw fault;
      }
    });
  };
}
