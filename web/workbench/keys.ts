// The keys of the page as a whole.

import { showKeys } from "./dialogs";

export interface KeyActions {
  save: () => void;
  run: () => void;
  stop: () => void;
  nextPane: (step: number) => void;
  nextProblem: (step: number) => void;
  showMachine: () => void;
}

export function listenToKeys(actions: KeyActions): void {
  document.addEventListener("keydown", (event) => {
    const command = event.ctrlKey || event.metaKey;
    const act = (work: () => void) => {
      event.preventDefault();
      event.stopPropagation();
      work();
    };
    if (document.querySelector("dialog[open]")) return;
    if (command && event.key.toLowerCase() === "s") act(actions.save);
    else if (command && event.key === "Enter" && !event.defaultPrevented) act(actions.run);
    else if (command && event.key === ".") act(actions.stop);
    else if (event.key === "F1") act(showKeys);
    else if (event.key === "F6") act(() => actions.nextPane(event.shiftKey ? -1 : 1));
    else if (event.key === "F8") act(() => actions.nextProblem(event.shiftKey ? -1 : 1));
    else if (event.altKey && event.key.toLowerCase() === "m") act(actions.showMachine);
  });
}
