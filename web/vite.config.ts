import { defineConfig } from "vitest/config";

const server = "http://127.0.0.1:8000";

export default defineConfig({
  base: "./",
  build: { target: "es2022" },
  server: { proxy: { "/api": server, "/data": server } },
  test: { include: ["tests/**/*.test.ts"] },
});
