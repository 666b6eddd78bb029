// Fields of which the page has some instants only, from a script beside it. A page opened from a folder cannot fetch files, but run scripts.

import type { DatasetText, Run } from "./data";

interface Given {
  run: string;
  datasets: Record<string, DatasetText>;
}

declare global {
  interface Window {
    herseyFields?: (given: Given) => void;
  }
}

/** Loads all instants of a bearing's film into its run. */
export function loadFields(run: Run, bearing: string): Promise<void> {
  const beside = run.fieldsBeside(bearing);
  if (!beside) return Promise.resolve();
  return new Promise((done, fail) => {
    const script = document.createElement("script");
    let taken = false;
    window.herseyFields = (given) => {
      if (given.run !== run.name) return;
      run.take(given.datasets);
      taken = true;
    };
    script.addEventListener("load", () => {
      script.remove();
      if (taken) done();
      else fail(new Error(`${beside.file} belongs to another report`));
    });
    script.addEventListener("error", () => fail(new Error(`${beside.file} is not beside this page`)));
    script.src = beside.file;
    document.head.append(script);
  });
}
