import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { licences } from "./scripts/licences.mjs";

export default defineConfig({
  plugins: [licences("The page of hersey's reports"), viteSingleFile({ removeViteModuleLoader: true })],
  build: { target: "es2022", cssCodeSplit: false, assetsInlineLimit: 100_000_000, reportCompressedSize: false },
});
