import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: { target: "es2022", cssCodeSplit: false, assetsInlineLimit: 100_000_000, reportCompressedSize: false },
});
