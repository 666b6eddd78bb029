// A plugin of the build: beside the bundle, licences.txt with the notices of all packages that are in it. Ends the build
// where a package has no notice, or a licence that asks for more than that its notice is kept.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";

const permissive = new Set(["MIT", "BSD-2-Clause", "BSD-3-Clause", "ISC", "Apache-2.0", "0BSD"]);

/** The folder of the package that a file belongs to; null for our own. */
function packageOf(file) {
  if (!file.includes("/node_modules/")) return null;
  for (let folder = dirname(file); folder.includes("/node_modules/"); folder = dirname(folder)) {
    const description = join(folder, "package.json");
    // Some packages have further descriptions, without a name, in folders of theirs.
    if (existsSync(description) && JSON.parse(readFileSync(description, "utf8")).version) return folder;
  }
  return null;
}

function noticeOf(folder) {
  const { name, version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((entry) => /^(licen[cs]e|copying)(\.(md|txt))?$/i.test(entry));
  if (!permissive.has(license)) throw new Error(`${name}: its licence is ${license}, which is not one of ${[...permissive].join(", ")}`);
  if (!file) throw new Error(`${name}: it has no notice`);
  return { name, text: `${name} ${version} (${license})\n\n${readFileSync(join(folder, file), "utf8").trim()}\n` };
}

export function licences(title) {
  return {
    name: "licences",
    generateBundle(_, bundle) {
      const folders = new Set();
      for (const chunk of Object.values(bundle))
        for (const [file, { renderedLength }] of Object.entries(chunk.modules ?? {})) {
          const folder = renderedLength > 0 ? packageOf(file.replace(/^\0/, "").replace(/\?.*$/, "")) : null;
          if (folder) folders.add(folder);
        }
      const notices = [...folders].map(noticeOf).sort((a, b) => a.name.localeCompare(b.name));
      const names = notices.map(({ name }) => name).join(", ");
      this.emitFile({ type: "asset", fileName: "licences.txt", source: `${title} contains these packages: ${names}.\n\n${notices.map(({ text }) => `${"-".repeat(80)}\n${text}`).join("\n")}` });
    },
  };
}
