/**
 * Runs a script of the project in TypeScript, which Node can't read by itself in all versions that the project supports:
 * `node tests/start.mjs attack/run.ts ARGUMENTS…`. It exports `run`, which returns the exit status.
 */
import { fileURLToPath } from 'node:url';
import { createServer, createServerModuleRunner } from 'vite';

const [script, ...args] = process.argv.slice(2);
const file = fileURLToPath(new URL(script, import.meta.url));
// `runnerImport` can't import anything once it is done, as functions do that fetch code on demand.
const server = await createServer({
  configFile: false,
  logLevel: 'warn',
  appType: 'custom',
  // Nothing of the page is served.
  optimizeDeps: { noDiscovery: true },
  server: { middlewareMode: true, hmr: false, ws: false, watch: null },
});
const module = await createServerModuleRunner(server.environments.ssr, { hmr: false }).import(file);
// Browsers and servers that are shared end with the process.
process.exit(await module.run(args));
