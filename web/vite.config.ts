import type { Plugin } from "vite";
import { defineConfig } from "vitest/config";

const server = "http://127.0.0.1:8000";

/** Every browser with WebGL2 reads woff2: the other font files of KaTeX would only fill the disk. */
const onlyWoff2: Plugin = {
  name: "only-woff2",
  enforce: "pre",
  transform(code, id) {
    if (!id.includes("katex") || !id.includes(".css")) return null;
    return code.replace(/,url\([^)]*\.(?:woff|ttf)\) format\("[a-z]*"\)/g, "");
  },
};

export default defineConfig({
  base: "./",
  plugins: [onlyWoff2],
  build: { target: "es2022" },
  server: { proxy: { "/api": server, "/data": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
