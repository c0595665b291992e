/**
 * Runs a script of the project in TypeScript: `node tests/start.mjs attack/run.ts ARGUMENTS…`. It exports `run`, which
 * returns the exit status.
 */
import './helpers/typescript.mjs';

const [script, ...args] = process.argv.slice(2);
const { run } = await import(new URL(script, import.meta.url).href);
// Browsers and servers that are shared end with the process.
process.exit(await run(args));
