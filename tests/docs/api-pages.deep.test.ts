/** The pages of the API, as `npm run docs` makes them from the doc comments; a warning of typedoc's fails. */
import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

it('the pages of the API are made without a warning', { timeout: 300_000 }, async () => {
  // `npm run test:types` checks the types.
  const options = ['--emit', 'none', '--logLevel', 'Warn', '--skipErrorChecking'];
  const typedoc = ['node_modules/typedoc/bin/typedoc', ...options];
  const { stdout, stderr } = await promisify(execFile)(process.execPath, typedoc, { cwd: ROOT });
  expect(stdout + stderr).toBe('');
});
