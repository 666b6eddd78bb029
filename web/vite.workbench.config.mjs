// The workbench: index.html, workbench.js and workbench.css, which the program serves, and licences.txt.
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { licences } from "./scripts/licences.mjs";

export default defineConfig({
  root: fileURLToPath(new URL("workbench", import.meta.url)),
  base: "/",
  plugins: [licences("The page of hersey's workbench")],
  build: {
    target: "es2022",
    outDir: fileURLToPath(new URL("dist/workbench", import.meta.url)),
    emptyOutDir: true,
    cssCodeSplit: false,
    assetsInlineLimit: 100_000_000,
    reportCompressedSize: false,
    modulePreload: false,
    chunkSizeWarningLimit: 2000,
    rollupOptions: { output: { entryFileNames: "workbench.js", assetFileNames: "workbench.[ext]", inlineDynamicImports: true } },
  },
});
