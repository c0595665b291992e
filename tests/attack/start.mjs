/** `npm run attack`: run.ts, which Node can't read by itself in all versions that the project supports. */
import { fileURLToPath } from 'node:url';
import { runnerImport } from 'vite';

const file = fileURLToPath(new URL('run.ts', import.meta.url));
const { module } = await runnerImport(file, { configFile: false, logLevel: 'warn' });
// Browsers and servers that are shared end with the process.
process.exit(await module.run(process.argv.slice(2)));
