// What the page contains beside our own code: its licence asks to travel with it (THIRD_PARTY.md).

import { h } from "./dom";

const packages = [
  { name: "uPlot", address: "github.com/leeoniya/uPlot", copyright: "© 2022 Leon Sorokin" },
  { name: "three.js", address: "threejs.org", copyright: "© 2010–2024 three.js authors" },
];

const mit = [
  "Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the “Software”), to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the following conditions:",
  "The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.",
  "The software is provided “as is”, without warranty of any kind, express or implied, including but not limited to the warranties of merchantability, fitness for a particular purpose and noninfringement. In no event shall the authors or copyright holders be liable for any claim, damages or other liability, whether in an action of contract, tort or otherwise, arising from, out of or in connection with the software or the use or other dealings in the software.",
];

/** The foot of the page. */
export function licences(): HTMLElement {
  const names = packages.map((p) => p.name).join(" and ");
  return h(
    "footer",
    { class: "licences" },
    h(
      "details",
      {},
      h("summary", {}, "Licences"),
      h("p", {}, `Figures of this page are drawn by ${names}, under the MIT licence:`),
      h("ul", {}, ...packages.map((p) => h("li", {}, `${p.name} (${p.address}), ${p.copyright}`))),
      ...mit.map((text) => h("p", {}, text)),
    ),
  );
}
