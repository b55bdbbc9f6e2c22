// Tasks that tick themselves. They stand in the article; each has a check that looks at the stage after every change.

import type { Stage } from "../model/stage";
import { h, say } from "./dom";

export type Check = (stage: Stage) => boolean;

/** Watches the tasks of a section: `checks` by the names that the article gives them. Opens the answer when all are done. */
export function watch(section: HTMLElement, stage: Stage, checks: Record<string, Check>): void {
  const items = [...section.querySelectorAll<HTMLElement>("[data-task]")];
  const answer = section.querySelector<HTMLDetailsElement>("details.answer");
  const aloud = h("p", { class: "unseen", "aria-live": "polite" });
  section.append(aloud);
  const open = new Set(items);
  stage.store.subscribe(() => {
    for (const item of open) {
      if (!checks[item.dataset["task"] ?? ""]?.(stage)) continue;
      open.delete(item);
      item.classList.add("done");
      say(aloud, `Task done: ${item.textContent}`);
      item.append(h("span", { class: "unseen" }, " Done."));
      if (open.size === 0 && answer) answer.open = true;
    }
  });
}
