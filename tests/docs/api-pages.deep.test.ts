/** The pages of the API, as `npm run docs` makes them from the doc comments; a warning of typedoc's fails. */
import { execFile } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../', import.meta.url));

it('the pages of the API are made without a warning', { timeout: 300_000 }, async () => {
  const typedoc = ['node_modules/typedoc/bin/typedoc', '--emit', 'none', '--logLevel', 'Warn'];
  const { stdout, stderr } = await promisify(execFile)(process.execPath, typedoc, { cwd: ROOT });
  expect(stdout + stderr).toBe('');
});
